#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "apps/export/formats.h"
#include "render/camera.h"
#include "render/normals.h"

namespace lagomorph::apps {

/// What tools that animate take of a body: single precision, smooth normals where the body is drawn so.
class MovingMesh {
public:
  /// `colors` of its vertices take the place of the base colour.
  MovingMesh(const sim::Surface&, const BodyDesc&, std::string name, std::vector<render::Color> colors = {});

  const std::string& name() const { return name_; }
  const render::Material& look() const { return look_; }
  const std::vector<render::Triangle>& triangles() const { return triangles_; }
  std::size_t vertex_count() const { return static_cast<std::size_t>(surface_->vertex_count()); }
  const std::vector<render::Color>& colors() const { return colors_; }
  bool has_normals() const { return normals_.has_value(); }
  /// [m]
  std::vector<render::Vec3> positions(const sim::VecX& q) const;
  /// Unit vectors.
  std::vector<render::Vec3> normals(const std::vector<render::Vec3>& positions) const;
  const sim::Surface& surface() const { return *surface_; }

private:
  const sim::Surface* surface_;
  std::string name_;
  render::Material look_;
  std::vector<render::Color> colors_;
  std::vector<render::Triangle> triangles_;
  std::optional<render::VertexNormals> normals_;
};

/// Whether a dielectric's part of the material is clear, or cloudy, inside.
inline bool has_clear_inside(const render::Material& m) {
  return m.transmission * (1.0F - m.metallic) > 0.0F;
}
inline bool has_cloudy_inside(const render::Material& m) {
  return m.subsurface * (1.0F - m.metallic) * (1.0F - m.transmission) > 0.0F;
}

/// In the order of the bodies.
std::vector<MovingMesh> moving_meshes(const ExportedScene&);

/// Least and greatest coordinates.
struct Extent {
  render::Vec3 min, max;
};
Extent extent_of(const std::vector<render::Vec3>&);

/// The eye's frame: x right, y up, looking along -z.
struct CameraPose {
  render::Vec3 position;  // [m]
  Eigen::Quaternionf rotation;
};
CameraPose pose_of(const render::CameraSettings&);

/// How near and far a camera need see: a hundredth and a hundred times what it looks at. [m]
inline float view_scale(const render::CameraSettings& camera) {
  return std::max((camera.look_at - camera.position).norm(), camera.orthographic.value_or(0.0F));
}
inline constexpr float kNear = 0.01F, kFar = 100.0F;  // times view_scale

}  // namespace lagomorph::apps
