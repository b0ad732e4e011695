#include "apps/pipeline/camera_rig.h"

namespace lagomorph::apps {
namespace {

/// Sum of M q over the sum of M.
sim::Vec3 center_of_mass(const sim::Model& model, const sim::VecX& q) {
  const sim::VecX mq = model.mass_times(q);
  sim::Vec3 sum = sim::Vec3::Zero();
  for (Eigen::Index i = 0; i < mq.size(); i += 3) sum += mq.segment<3>(i);
  return sum / model.total_mass();
}

}  // namespace

CameraRig::CameraRig(const SceneDesc& scene, const sim::Model& model,
                     const std::vector<sim::Surface>& surfaces, int width, int height)
    : model_(model),
      surfaces_(surfaces),
      moves_(scene.camera, scene.time, static_cast<double>(width) / height),
      width_(width),
      height_(height),
      follows_(scene.camera.follow != "none"),
      needs_all_states_(scene.camera.frame == "motion"),
      fits_(scene.camera.frame == "rest" || scene.camera.frame == "motion"),
      center_of_mass_(sim::Vec3::Zero()) {
  const sim::VecX q = model.initial_state().q;
  if (follows_) center_of_mass_ = center_of_mass(model, q);
  if (scene.camera.frame == "none") return;
  see(q);
}

sim::Vec3 CameraRig::offset(const sim::VecX& q) const {
  if (!follows_) return sim::Vec3::Zero();
  return center_of_mass(model_, q) - center_of_mass_;
}

void CameraRig::see(const sim::VecX& q) {
  if (!box_) box_.emplace();
  const sim::Vec3 moved = offset(q);
  for (const sim::Surface& surface : surfaces_) {
    const sim::Points points = surface.positions(q);
    if (!points.allFinite()) continue;
    box_->extend(sim::Vec3(points.colwise().minCoeff().transpose() - moved));
    box_->extend(sim::Vec3(points.colwise().maxCoeff().transpose() - moved));
  }
}

std::optional<std::array<double, 6>> CameraRig::fitted_box() const {
  if (!box_ || box_->isEmpty()) return std::nullopt;
  const sim::Vec3 low = box_->min(), high = box_->max();
  return std::array<double, 6>{low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

render::CameraSettings CameraRig::settings(double frame, const sim::VecX& q, double strip) const {
  render::CameraSettings settings = moves_.at(frame, box_, strip);
  shift(settings, offset(q));
  return settings;
}

render::Camera CameraRig::at(double frame, const sim::VecX& q, double strip) const {
  return {settings(frame, q, strip), width_, height_};
}

}  // namespace lagomorph::apps
