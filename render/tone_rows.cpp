#include "render/tone_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "render/error.h"
#include "render/simd.h"
#include "render/srgb_curve.h"

namespace lagomorph::render {
namespace {

constexpr std::size_t tone_block = 64;  // pixels at once
using ToneValues = std::array<float, tone_block>;
using ToneCodes = std::array<std::int32_t, tone_block>;

int srgb_code(float linear) { return static_cast<int>(std::floor(255.0 * srgb_curve(linear) + 0.5)); }

/// The exact curve to 8 bits without a power a pixel: the smallest float of every code, in buckets of a 256th
/// of an octave from 2^-13 (code 0) to 1. A bucket holds one such threshold at most.
class SrgbTable {
public:
  SrgbTable() {
    std::array<float, 257> threshold{};
    for (int k = 1; k <= 255; ++k) {
      auto x = static_cast<float>(inverse_srgb_curve((k - 0.5) / 255.0));
      while (srgb_code(x) >= k) x = std::nextafter(x, 0.0F);
      while (srgb_code(x) < k) x = std::nextafter(x, 1.0F);
      threshold[static_cast<std::size_t>(k)] = x;
    }
    threshold[256] = 2.0F;
    for (int k = 0; k <= 255; ++k)
      whole_[static_cast<std::size_t>(k)] = static_cast<float>(inverse_srgb_curve(k / 255.0));
    whole_[256] = 2.0F;
    for (std::int32_t i = 0; i < buckets; ++i) {
      const std::int32_t first = (i << shift) + lowest;
      const std::int32_t code = srgb_code(std::bit_cast<float>(first)), next = code + 1;
      const std::int32_t to_next =
          std::bit_cast<std::int32_t>(threshold[static_cast<std::size_t>(next)]) - first;
      buckets_[static_cast<std::size_t>(i)] = (code << shift) + std::max(inside - to_next, 0);
    }
  }

  /// Of values that are not NaN.
  LAGOMORPH_INLINE void find(const ToneValues& linear, ToneCodes& codes) const {
    alignas(64) ToneValues x;
    alignas(64) ToneCodes bits;
    for (std::size_t i = 0; i < tone_block; ++i) x[i] = std::min(std::max(linear[i], 0x1p-13F), 1.0F);
    std::memcpy(bits.data(), x.data(), sizeof(bits));  // for all at once, or nothing becomes vector code
    for (std::size_t i = 0; i < tone_block; ++i) {
      const std::int32_t at = bits[i] - lowest;
      codes[i] = (buckets_[static_cast<std::size_t>(at >> shift)] + (at & (inside - 1))) >> shift;
    }
  }

  /// The codes of what is `offset` codes above, linear in light between two codes.
  LAGOMORPH_INLINE void find(const ToneValues& linear, const ToneValues& offset, ToneCodes& codes) const {
    alignas(64) ToneCodes nearest;
    find(linear, nearest);
    for (std::size_t i = 0; i < tone_block; ++i) {
      const float x = std::min(std::max(linear[i], 0.0F), 1.0F);
      const std::int32_t k = nearest[i] - (x < whole_[static_cast<std::size_t>(nearest[i])] ? 1 : 0);
      const std::int32_t next = k + 1;
      const float low = whole_[static_cast<std::size_t>(k)], high = whole_[static_cast<std::size_t>(next)];
      const float value = static_cast<float>(k) + ((x - low) / (high - low) + (0.5F + offset[i]));
      codes[i] = static_cast<std::int32_t>(std::min(std::max(value, 0.0F), 255.0F));  // floor
    }
  }

private:
  static constexpr std::int32_t shift = 15, inside = 1 << shift;  // floats of a bucket
  static constexpr std::int32_t lowest = std::bit_cast<std::int32_t>(0x1p-13F);
  static constexpr std::int32_t buckets = ((std::bit_cast<std::int32_t>(1.0F) - lowest) >> shift) + 1;
  std::array<float, 257> whole_{};  // linear light of each code
  /// Code of the first float, times 2^shift, and what is to be added for that to become the next one's at
  /// the threshold: one look in place of two, which each take longer than all else.
  std::array<std::int32_t, buckets> buckets_{};
};

struct Rgb {
  float r, g, b;
};

// Tone curves: exposed linear colour, finite and not negative, to display linear; what leaves [0, 1] is
// clamped.

struct ClampOnly {
  LAGOMORPH_INLINE static Rgb map(const Rgb& c) { return c; }
};

/// L / (1 + L) on the Rec. 709 luminance L, hue and saturation kept [Reinhard 2002, Eq. 3].
struct Reinhard {
  LAGOMORPH_INLINE static Rgb map(const Rgb& c) {
    const float scale = 1.0F / (1.0F + (0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b));
    return {c.r * scale, c.g * scale, c.b * scale};
  }
};

/// Stephen Hill's fit of the ACES reference rendering and sRGB output transforms (BakingLab, ACES.hlsl).
struct Aces {
  LAGOMORPH_INLINE static float fit(float v) {
    return (v * (v + 0.0245786F) - 0.000090537F) / (v * (0.983729F * v + 0.4329510F) + 0.238081F);
  }
  LAGOMORPH_INLINE static Rgb map(const Rgb& c) {
    const float r = fit(0.59719F * c.r + 0.35458F * c.g + 0.04823F * c.b);
    const float g = fit(0.07600F * c.r + 0.90834F * c.g + 0.01566F * c.b);
    const float b = fit(0.02840F * c.r + 0.13383F * c.g + 0.83777F * c.b);
    return {1.60475F * r - 0.53108F * g - 0.07367F * b, -0.10208F * r + 1.10813F * g - 0.00605F * b,
            -0.00327F * r - 0.07276F * g + 1.07602F * b};
  }
};

/// Khronos PBR Neutral Tone Mapper: colours under 0.76 keep their base colour, highlights are compressed and
/// desaturated (github.com/KhronosGroup/ToneMapping).
struct PbrNeutral {
  LAGOMORPH_INLINE static Rgb map(const Rgb& in) {
    constexpr float start = 0.8F - 0.04F;
    constexpr float desaturation = 0.15F;
    constexpr float d = 1.0F - start;
    const float low = std::min(std::min(in.r, in.g), in.b);
    const float toe = low < 0.08F ? low - 6.25F * low * low : 0.04F;
    const Rgb c = {in.r - toe, in.g - toe, in.b - toe};
    const float peak = std::max(std::max(c.r, c.g), c.b);
    const float bright = std::max(peak, start);  // the same from there on
    const float new_peak = 1.0F - d * d / (bright + d - start);
    const float white = 1.0F - 1.0F / (desaturation * (bright - new_peak) + 1.0F);
    const float scale = new_peak / bright * (1.0F - white), add = new_peak * white;
    const bool dim = peak < start;
    return {dim ? c.r : c.r * scale + add, dim ? c.g : c.g * scale + add, dim ? c.b : c.b * scale + add};
  }
};

struct alignas(64) ToneBlock {
  ToneValues r, g, b, offset;
};

LAGOMORPH_INLINE float dither_at(const Dither& dither, std::size_t pixel) {
  const auto x = static_cast<std::uint32_t>(pixel % dither.width),
             y = static_cast<std::uint32_t>(pixel / dither.width);
  const std::uint32_t point = x * 3242174889U + y * 2447445414U;  // 2^32 / p and / p^2, p^3 = p + 1
  return dither.amount * (static_cast<float>(static_cast<std::int32_t>(point >> 8U)) * 0x1p-24F - 0.5F);
}

/// The pixels of a block, each exposed and shown by the curve; NaN is black.
template <class Curve>
LAGOMORPH_INLINE void show_block(const ToneRange& p, std::size_t first, std::size_t count, ToneBlock& block) {
  constexpr float brightest = 1e8F;  // keeps infinite light finite in the curves
  const float* linear = p.linear + 3 * first;
  const float scale = p.scale;
  for (std::size_t i = 0; i < count; ++i) {
    block.r[i] = scale * linear[3 * i];
    block.g[i] = scale * linear[3 * i + 1];
    block.b[i] = scale * linear[3 * i + 2];
  }
  if (p.alpha != nullptr) {
    const float* alpha = p.alpha + first;
    for (std::size_t i = 0; i < count; ++i) {
      const float by = alpha[i] > 0.0F ? alpha[i] : 1.0F;
      block.r[i] /= by, block.g[i] /= by, block.b[i] /= by;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Rgb c = {block.r[i], block.g[i], block.b[i]};
    const int numbers =
        static_cast<int>(c.r == c.r) & static_cast<int>(c.g == c.g) & static_cast<int>(c.b == c.b);
    const auto bounded = [=](float x) {
      return numbers != 0 ? std::min(std::max(x, 0.0F), brightest) : 0.0F;
    };
    const Rgb shown = Curve::map({bounded(c.r), bounded(c.g), bounded(c.b)});
    block.r[i] = shown.r, block.g[i] = shown.g, block.b[i] = shown.b;
  }
}

template <class Curve>
LAGOMORPH_INLINE void map_tones(const SrgbTable& srgb, const ToneRange& p, std::uint8_t* rgb) {
  ToneBlock block{};
  alignas(64) ToneCodes codes;
  for (std::size_t first = p.first; first < p.last; first += tone_block) {
    const std::size_t count = std::min(tone_block, p.last - first);
    show_block<Curve>(p, first, count, block);
    const bool dithers = p.dither.amount > 0.0F;
    if (dithers) {
      for (std::size_t i = 0; i < count; ++i) block.offset[i] = dither_at(p.dither, first + i);
    }
    std::uint8_t* to = rgb + 3 * first;
    for (const ToneValues* shown : {&block.r, &block.g, &block.b}) {
      dithers ? srgb.find(*shown, block.offset, codes) : srgb.find(*shown, codes);
      for (std::size_t i = 0; i < count; ++i) to[3 * i] = static_cast<std::uint8_t>(codes[i]);
      ++to;
    }
  }
}

const SrgbTable& srgb_table() {
  static const SrgbTable table;
  return table;
}

LAGOMORPH_RENDER_SIMD void map_clamped(const ToneRange& p, std::uint8_t* rgb) {
  map_tones<ClampOnly>(srgb_table(), p, rgb);
}
LAGOMORPH_RENDER_SIMD void map_reinhard(const ToneRange& p, std::uint8_t* rgb) {
  map_tones<Reinhard>(srgb_table(), p, rgb);
}
LAGOMORPH_RENDER_SIMD void map_aces(const ToneRange& p, std::uint8_t* rgb) {
  map_tones<Aces>(srgb_table(), p, rgb);
}
LAGOMORPH_RENDER_SIMD void map_neutral(const ToneRange& p, std::uint8_t* rgb) {
  map_tones<PbrNeutral>(srgb_table(), p, rgb);
}

struct CurveRow {
  const char* name;
  MapTones map;
};
constexpr CurveRow curves[] = {
    {"none", map_clamped}, {"reinhard", map_reinhard}, {"aces", map_aces}, {"pbr_neutral", map_neutral}};

}  // namespace

std::vector<std::string> tone_curve_names() {
  std::vector<std::string> names;
  for (const CurveRow& row : curves) names.emplace_back(row.name);
  return names;
}

MapTones find_tone_curve(std::string_view name) {
  for (const CurveRow& row : curves) {
    if (name == row.name) return row.map;
  }
  std::string known;
  for (const CurveRow& row : curves) known += std::string(known.empty() ? "" : ", ") + row.name;
  throw SettingsError("render.tone_curve: unknown curve '" + std::string(name) + "'; known are " + known);
}

}  // namespace lagomorph::render
