#include "render/path/light.h"

namespace lagomorph::render::path {

RectangleLight::RectangleLight(const AreaLight& light)
    : radiance_(light.color * light.radiance), visible_(light.visible) {
  const LightFrame frame = light_frame(light);
  shape_ = {f3(light.position), f3(frame.right), f3(frame.up),
            f3(frame.normal),   light.size.x(),  light.size.y()};
}

float RectangleLight::power() const { return shape_.width * shape_.height * luminance(f3(radiance_)); }

RectangleLight::Sample RectangleLight::sample(const Vec3& p, Pair s) const {
  const LightSample to = sample_rectangle(shape_, f3(p), s.u, s.v);
  if (to.pdf <= 0.0F) return {};
  return {vec3(to.direction), to.distance, to.pdf};
}

RectangleLight::Hit RectangleLight::intersect(const Ray& ray) const {
  const float t = meet_rectangle(shape_, f3(ray.origin), f3(ray.direction));
  if (t <= 0.0F) return {};
  return {t, ray.origin + t * ray.direction};
}

float RectangleLight::pdf(const Vec3& p, const Vec3& point) const {
  const RectangleView view = view_from(shape_, f3(p));
  if (view.z0 <= 0.0F) return 0.0F;
  return view.small ? area_to_solid_angle(shape_, f3(Vec3(point - p))) : 1.0F / view.solid_angle;
}

}  // namespace lagomorph::render::path
