#include "render/albedo.h"

namespace lagomorph::render {

Color albedo(const Material& m) {
  Color color = m.base_color;
  const float cloudy = (1.0F - m.metallic) * m.subsurface;
  color += cloudy * (m.subsurface_color - color);
  color += clear_part(m) * (m.absorption_color - color);
  return color;
}

float clear_part(const Material& m) { return (1.0F - m.metallic) * m.transmission; }

float dielectric_f0(const Material& m) {
  const float r = (m.ior - 1.0F) / (m.ior + 1.0F);
  return r * r;
}

Material coat_of(const Material& m) { return {Color::Zero(), m.coat_roughness, 0.0F, 1.5F}; }

}  // namespace lagomorph::render
