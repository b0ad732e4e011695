#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/normals.h"
#include "render/raster/gl_objects.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// True when every edge has exactly one neighbour that runs the other way, and the inside is inside (positive
/// volume): then no back face is ever seen, and culling them halves the cost.
bool is_closed(std::span<const Triangle>, std::span<const Vec3> positions);

/// A mesh on the GL side: indices are uploaded once, positions and normals when they change.
class MeshBuffers {
public:
  /// `clear`: see drawn_by_rays().
  explicit MeshBuffers(const Mesh&, bool clear = false);

  void upload(std::span<const Vec3> positions);
  /// Where it was at the frame before, attribute 3; new positions make it stand still.
  void upload_previous(std::span<const Vec3> positions);
  /// Of a colored() mesh.
  void upload(std::span<const Color> colors);
  /// All triangles, with position and, where it has them, normal and colour as attributes 0, 1 and 2.
  void draw() const;

  std::span<const Triangle> triangles() const { return triangles_; }
  const Material& material() const { return material_; }
  bool smooth() const { return smooth_; }
  bool closed() const { return closed_; }
  bool colored() const { return colored_; }
  bool moves() const { return moves_; }
  bool clear() const { return clear_; }
  /// Part of the light that it stops.
  float opacity_to_light() const { return opacity_to_light_; }
  bool see_through() const { return material_.opacity < 1.0F; }
  int body_id() const { return body_id_; }

private:
  std::vector<Triangle> triangles_;
  VertexNormals topology_;
  std::vector<Vec3> normals_;
  Material material_;
  int body_id_;
  bool smooth_, closed_, colored_, clear_;
  float opacity_to_light_;
  bool moves_ = false;
  VertexArray vertex_array_;
  Buffer indices_, position_buffer_, normal_buffer_, color_buffer_;
  std::optional<Buffer> previous_buffer_;  // made when it is asked for
};

}  // namespace lagomorph::render::raster
