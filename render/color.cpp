#include "render/color.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/channels.h"
#include "render/error.h"

namespace lagomorph::render {
namespace {

double srgb_curve(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double inverse_srgb_curve(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

int srgb_code(float linear) { return static_cast<int>(std::floor(255.0 * srgb_curve(linear) + 0.5)); }

/// The exact curve to 8 bits without a power a pixel: the smallest float of every code, and the code at the
/// start of every 256th of an octave from 2^-13 (code 0) to 1. A bucket holds one threshold at most.
class SrgbTable {
public:
  SrgbTable() {
    for (int k = 1; k <= 255; ++k) {
      auto x = static_cast<float>(inverse_srgb_curve((k - 0.5) / 255.0));
      while (srgb_code(x) >= k) x = std::nextafter(x, 0.0F);
      while (srgb_code(x) < k) x = std::nextafter(x, 1.0F);
      threshold_[static_cast<std::size_t>(k)] = x;
    }
    threshold_[256] = 2.0F;
    for (int k = 0; k <= 255; ++k)
      whole_[static_cast<std::size_t>(k)] = static_cast<float>(inverse_srgb_curve(k / 255.0));
    whole_[256] = 2.0F;
    for (std::uint32_t i = 0; i < buckets; ++i) {
      const float start = std::bit_cast<float>((i << shift) + lowest);
      start_[i] = static_cast<std::uint8_t>(srgb_code(start));
    }
  }

  /// `linear` is not NaN.
  std::uint8_t code(float linear) const {
    const float above = linear > 0x1p-13F ? linear : 0x1p-13F;
    const float x = above < 1.0F ? above : 1.0F;
    const std::uint32_t c = start_[(std::bit_cast<std::uint32_t>(x) - lowest) >> shift];
    return static_cast<std::uint8_t>(c + (x >= threshold_[c + 1] ? 1U : 0U));
  }

  /// The code of what is `offset` codes above, linear in light between two codes. `linear` is not NaN.
  std::uint8_t code(float linear, float offset) const {
    const float x = std::clamp(linear, 0.0F, 1.0F);
    std::uint32_t k = code(x);
    if (x < whole_[k]) --k;
    const float part = (x - whole_[k]) / (whole_[k + 1] - whole_[k]);
    const float value = std::floor(static_cast<float>(k) + (part + (0.5F + offset)));
    return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F));
  }

private:
  static constexpr std::uint32_t shift = 15;
  static constexpr std::uint32_t lowest = std::bit_cast<std::uint32_t>(0x1p-13F);
  static constexpr std::uint32_t buckets = ((std::bit_cast<std::uint32_t>(1.0F) - lowest) >> shift) + 1;
  std::array<float, 257> threshold_{};
  std::array<float, 257> whole_{};  // linear light of each code
  std::array<std::uint8_t, buckets> start_{};
};

// Tone curves: exposed linear colour, finite and not negative, to display linear; what leaves [0, 1] is
// clamped.

Color clamp_only(const Color& c) { return c; }

/// L / (1 + L) on the Rec. 709 luminance L, hue and saturation kept [Reinhard 2002, Eq. 3].
Color reinhard(const Color& c) {
  const float luminance = 0.2126F * c.x() + 0.7152F * c.y() + 0.0722F * c.z();
  return c * (1.0F / (1.0F + luminance));
}

/// Stephen Hill's fit of the ACES reference rendering and sRGB output transforms (BakingLab, ACES.hlsl).
Color aces(const Color& c) {
  const Color v(0.59719F * c.x() + 0.35458F * c.y() + 0.04823F * c.z(),
                0.07600F * c.x() + 0.90834F * c.y() + 0.01566F * c.z(),
                0.02840F * c.x() + 0.13383F * c.y() + 0.83777F * c.z());
  const Color r = (v * (v + 0.0245786F) - 0.000090537F) / (v * (0.983729F * v + 0.4329510F) + 0.238081F);
  return {1.60475F * r.x() - 0.53108F * r.y() - 0.07367F * r.z(),
          -0.10208F * r.x() + 1.10813F * r.y() - 0.00605F * r.z(),
          -0.00327F * r.x() - 0.07276F * r.y() + 1.07602F * r.z()};
}

/// Khronos PBR Neutral Tone Mapper: colours under 0.76 keep their base colour, highlights are compressed and
/// desaturated (github.com/KhronosGroup/ToneMapping).
Color pbr_neutral(const Color& in) {
  constexpr float start = 0.8F - 0.04F;
  constexpr float desaturation = 0.15F;
  constexpr float d = 1.0F - start;
  const float low = in.minCoeff();
  const Color c = in - (low < 0.08F ? low - 6.25F * low * low : 0.04F);
  const float peak = c.maxCoeff();
  if (peak < start) return c;
  const float new_peak = 1.0F - d * d / (peak + d - start);
  const float white = 1.0F - 1.0F / (desaturation * (peak - new_peak) + 1.0F);
  return c * (new_peak / peak * (1.0F - white)) + new_peak * white;
}

/// What is added to 8-bit values before they are rounded, of a width of `amount`: the R2 sequence, whose
/// neighbours are far apart [Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"]. The
/// same for red, green and blue, so that grey stays grey, and in all frames.
struct Dither {
  float amount = 0.0F;
  std::size_t width = 1;  // of the picture

  float at(std::size_t pixel) const {
    const auto x = static_cast<std::uint32_t>(pixel % width), y = static_cast<std::uint32_t>(pixel / width);
    const std::uint32_t point = x * 3242174889U + y * 2447445414U;  // 2^32 / p and / p^2, p^3 = p + 1
    return amount * (static_cast<float>(point >> 8U) * 0x1p-24F - 0.5F);
  }
};

/// Pixels first .. last - 1 of a picture. `alpha`: of each pixel, that its colour is divided by; nullptr: 1.
struct ToneRange {
  const float* linear;
  const float* alpha;
  std::size_t first, last;
  float scale;
  Dither dither;
};

template <Color (*curve)(const Color&)>
void map_pixels(const ToneRange& p, std::uint8_t* rgb) {
  static const SrgbTable srgb;
  constexpr float brightest = 1e8F;  // keeps infinite light finite in the curves
  for (std::size_t pixel = p.first; pixel < p.last; ++pixel) {
    const float* linear = p.linear + 3 * pixel;
    Color c = p.scale * Color(linear[0], linear[1], linear[2]);
    if (p.alpha != nullptr && p.alpha[pixel] > 0.0F) c /= p.alpha[pixel];
    const bool nan = std::isnan(c.x() + c.y() + c.z()) && c.isNaN().any();
    const Color display = nan ? Color(Color::Zero()) : curve(c.max(0.0F).min(brightest));
    std::uint8_t* const to = rgb + 3 * pixel;
    if (p.dither.amount > 0.0F) {
      const float offset = p.dither.at(pixel);
      for (int k = 0; k < 3; ++k) to[k] = srgb.code(display[k], offset);
    } else {
      for (int k = 0; k < 3; ++k) to[k] = srgb.code(display[k]);
    }
  }
}

struct Row {
  const char* name;
  void (*map)(const ToneRange&, std::uint8_t* rgb);
};
constexpr Row curves[] = {
    {"none", map_pixels<clamp_only>},
    {"reinhard", map_pixels<reinhard>},
    {"aces", map_pixels<aces>},
    {"pbr_neutral", map_pixels<pbr_neutral>},
};

const Row& find_curve(std::string_view name) {
  for (const Row& row : curves) {
    if (name == row.name) return row;
  }
  std::string known;
  for (const Row& row : curves) known += std::string(known.empty() ? "" : ", ") + row.name;
  throw SettingsError("render.tone_curve: unknown curve '" + std::string(name) + "'; known are " + known);
}

}  // namespace

float srgb_from_linear(float linear) {
  return static_cast<float>(srgb_curve(std::clamp(static_cast<double>(linear), 0.0, 1.0)));
}

float linear_from_srgb(float srgb) {
  const double s = std::clamp(static_cast<double>(srgb), 0.0, 1.0);
  return static_cast<float>(inverse_srgb_curve(s));
}

std::vector<std::string> tone_curve_names() {
  std::vector<std::string> names;
  for (const Row& row : curves) names.emplace_back(row.name);
  return names;
}

Picture tone_map(const Image& image, std::string_view curve, float exposure, bool transparent, float dither) {
  const Row& row = find_curve(curve);
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
                      row.map({color->values.data(),
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
