#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "render/normals.h"
#include "render/path/geometry_formulas.h"
#include "render/path/ray_caster.h"
#include "render/path/surface_rows.h"
#include "render/render_scene.h"

namespace lagomorph::render::path {

/// A point where a ray arrived, and from where rays go on.
struct SurfacePoint {
  Vec3 origin;  // of rays that go on: off the surface on the side of the arrival, so that they do not meet it
                // again
  Vec3 normal;  // unit shading normal, on the side of the arrival, bent for the arrival to be above it
  Vec3 beyond = Vec3::Zero();  // of rays that go through, where the mesh's material lets any
  bool inside = false;         // the arrival is from the back of its triangle
  Vec3 unbent = Vec3::Zero();  // the normal as the surface has it
};

/// The meshes and the ground as a ray sees them: what the hierarchy's answers mean in space.
class SceneGeometry {
public:
  /// Throws DeviceError as RayCaster does. The scene is checked (check_scene).
  explicit SceneGeometry(const RenderScene&);

  void move(int mesh, std::span<const Vec3> positions);
  void color(int mesh, std::span<const Color> colors);
  /// Where the mesh is at the time steps before the last, one for each of the scene's motion_segments; move()
  /// makes it stand still.
  void set_motion(int mesh, std::span<const std::vector<Vec3>> positions);
  bool moving() const { return segments_ > 0; }
  /// Where the mesh was at the frame before, for previous_at(); move() makes it stand still.
  void set_previous(int mesh, std::span<const Vec3> positions);
  /// Makes the normals and the hierarchy follow what has moved.
  void commit();
  const RayCaster& caster() const { return caster_; }

  TriangleHit meet(const Ray&, const MeshHit&) const;
  /// The vertices of the triangle of a hit at a time and, of a smooth mesh, their normals, for meeting `at`.
  void put_corners(const MeshHit&, float time, Meetings&, std::size_t at) const;
  bool is_smooth(std::size_t mesh) const { return meshes_[mesh].smooth; }
  const GroundDisc& ground() const { return disc_; }
  /// The surface at a hit.
  SurfacePoint arrive(const Ray&, const MeshHit&, const TriangleHit&) const;
  /// Where a ray goes on straight behind a hit, so that it does not meet it again.
  Vec3 behind(const Ray&, const MeshHit&, const TriangleHit&) const;
  /// Where a hit is at time 1, and where that point of the mesh was at the frame before.
  Vec3 position_at(const MeshHit&, const TriangleHit&) const;
  Vec3 previous_at(const MeshHit&, const TriangleHit&) const;
  /// Its colour, of a mesh whose vertices have some.
  std::optional<Color> color_at(const MeshHit&, const TriangleHit&) const;

  static constexpr double never = std::numeric_limits<double>::infinity();
  /// Whether the ground is there.
  void show_ground(bool shown) {
    disc_.met = shown ? static_cast<double>(disc_.radius) * disc_.radius : -1.0;
  }
  /// Distance to the ground's disc, from either side; `never` where a ray misses it.
  double meet_ground(const Ray&) const;
  /// Point of the ground's plane at a distance.
  Vec3 ground_point(const Ray&, double t) const;
  SurfacePoint arrive_at_ground(const Ray&, double t) const;

private:
  struct Moving {
    std::vector<Triangle> triangles;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  // a vertex; empty when not smooth
    VertexNormals topology;
    bool smooth;
    bool moved;
    std::vector<Color> colors;                   // a vertex; or none
    std::vector<std::vector<Vec3>> way;          // positions at the time steps before the last; empty when it
                                                 // stands still
    std::vector<std::vector<Vec3>> way_normals;  // likewise; empty when not smooth
    std::vector<Vec3> previous;                  // positions at the frame before; empty when it stands still
  };
  Vec3 position(const Moving&, std::uint32_t vertex, float time) const;
  Corners corners(const Moving&, const Triangle&, float time) const;
  Vec3 normal(const Moving&, std::uint32_t vertex, float time) const;
  Corners normals(const Moving&, const Triangle&, float time) const;
  std::vector<Moving> meshes_;
  GroundDisc disc_;
  int segments_;  // of motion
  RayCaster caster_;
};

}  // namespace lagomorph::render::path
