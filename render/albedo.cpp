#include "render/albedo.h"

namespace lagomorph::render {

Color albedo(const Material& m) {
  Color color = m.base_color;
  const float cloudy = (1.0F - m.metallic) * m.subsurface;
  const float clear = (1.0F - m.metallic) * m.transmission;
  color += cloudy * (m.subsurface_color - color);
  color += clear * (m.absorption_color - color);
  return color;
}

}  // namespace lagomorph::render
