#include "render/color.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/channels.h"
#include "render/error.h"
#include "render/srgb_curve.h"
#include "render/tone_rows.h"

namespace lagomorph::render {
float srgb_from_linear(float linear) {
  return static_cast<float>(srgb_curve(std::clamp(static_cast<double>(linear), 0.0, 1.0)));
}

float linear_from_srgb(float srgb) {
  const double s = std::clamp(static_cast<double>(srgb), 0.0, 1.0);
  return static_cast<float>(inverse_srgb_curve(s));
}

Picture tone_map(const Image& image, std::string_view curve, float exposure, bool transparent, float dither) {
  const MapTones map = find_tone_curve(curve);
  const Channel* color = image.find("color");
  if (color == nullptr || color->components != 3) {
    throw SettingsError("the image has no channel 'color' of 3 components to make a picture of");
  }
  const Channel* alpha = transparent ? image.find(alpha_channel) : nullptr;
  if (transparent && alpha == nullptr)
    throw SettingsError("the image has no channel 'alpha' to make a transparent picture of");
  const float scale = std::exp2(exposure);
  Picture picture{image.width(), image.height(), std::vector<std::uint8_t>(color->values.size())};
  if (alpha != nullptr) {
    picture.alpha.reserve(alpha->values.size());
    for (const float a : alpha->values)
      picture.alpha.push_back(static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(a, 0.0F, 1.0F))));
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, color->values.size() / 3, 16384),
                    [&](const auto& range) {
                      map({color->values.data(),
                           alpha != nullptr ? alpha->values.data() : nullptr,
                           range.begin(),
                           range.end(),
                           scale,
                           {dither, static_cast<std::size_t>(image.width())}},
                          picture.rgb.data());
                    });
  return picture;
}

}  // namespace lagomorph::render
