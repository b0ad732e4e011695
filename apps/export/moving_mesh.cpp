#include "apps/export/moving_mesh.h"

#include <utility>

#include "apps/pipeline/build_scene.h"

namespace lagomorph::apps {

MovingMesh::MovingMesh(const sim::Surface& surface, const BodyDesc& body, std::string name,
                       std::vector<render::Color> colors)
    : surface_(&surface), name_(std::move(name)), look_(body.look), colors_(std::move(colors)) {
  if (!colors_.empty()) look_.base_color = render::Color::Ones();
  for (const sim::Triangle& t : surface.triangles()) triangles_.push_back(to_render(t));
  if (body.surface.smooth) normals_.emplace(triangles_, vertex_count());
}

std::vector<render::Vec3> MovingMesh::positions(const sim::VecX& q) const {
  return to_render(surface_->positions(q));
}

std::vector<render::Vec3> MovingMesh::normals(const std::vector<render::Vec3>& positions) const {
  std::vector<render::Vec3> normals;
  normals_->compute(triangles_, positions, normals);
  return normals;
}

std::vector<MovingMesh> moving_meshes(const ExportedScene& scene) {
  std::vector<MovingMesh> meshes;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    meshes.emplace_back(scene.surfaces[i], scene.desc.body[i], scene.model.mesh().bodies[i].name,
                        scene.colors.empty() ? std::vector<render::Color>() : scene.colors[i]);
  return meshes;
}

CameraPose pose_of(const render::CameraSettings& settings) {
  const render::Camera camera(settings, 1, 1);
  Eigen::Matrix3d axes;
  axes << camera.right().cast<double>(), camera.up().cast<double>(), -camera.forward().cast<double>();
  return {camera.position(), Eigen::Quaterniond(axes).normalized().cast<float>()};
}

Extent extent_of(const std::vector<render::Vec3>& points) {
  Extent extent{points.at(0), points.at(0)};
  for (const render::Vec3& p : points) {
    extent.min = extent.min.cwiseMin(p);
    extent.max = extent.max.cwiseMax(p);
  }
  return extent;
}

}  // namespace lagomorph::apps
