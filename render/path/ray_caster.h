#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "render/camera.h"
#include "render/path/rows.h"
#include "render/render_scene.h"

namespace lagomorph::render::path {

/// What a ray meets first among the meshes.
struct MeshHit {
  static constexpr std::uint32_t none = 0xffffffffU;
  std::uint32_t mesh = none;
  std::uint32_t triangle = 0;
};

/// Rays of a call that begin together and go the same way are traced as one packet.
enum class Coherence { coherent, incoherent };

/// The meshes' triangles in an Embree scene. Everything of Embree is in ray_caster.cpp, so that its version
/// can change.
///
/// The hierarchy's topology is made from the positions given to build(); move() and commit() refit its boxes.
/// So the hierarchy of a frame is a function of that frame's positions, whatever was drawn before. With
/// `segments` of motion, meshes have positions at that many equidistant times and the frame's, go straight
/// between them, and commit() makes the hierarchy anew, in one thread. Which triangle is hit is all that is
/// taken from Embree; see SceneGeometry::arrive.
class RayCaster {
public:
  /// Throws DeviceError when there is no Embree device.
  RayCaster();
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Throws DeviceError when Embree cannot build it.
  void build(std::span<const Mesh> meshes, int segments = 0);
  /// New positions of a mesh, as many as it has; seen after commit().
  void move(int mesh, std::span<const Vec3> positions);
  /// The same at time step / segments, below 1; move() gives those at time 1.
  void move_at(int step, int mesh, std::span<const Vec3> positions);
  void commit();

  /// Closest hits, one a ray; both sides of a triangle count.
  void intersect(std::span<const Ray> rays, Coherence, std::span<MeshHit> hits) const;
  void intersect(const RayRows& rays, Coherence, std::span<MeshHit> hits) const;
  /// Whether anything is in the way before the rays' `far`, one a ray.
  void occluded(const RayRows& rays, Coherence, std::span<std::uint8_t> blocked) const;

  /// Embree's version and instruction set.
  std::string description() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lagomorph::render::path
