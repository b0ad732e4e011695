#pragma once

#include <cstdint>
#include <optional>

#include "render/image_compare/error_map.h"
#include "render/pixels.h"

namespace lagomorph::render {

/// Plain differences of the samples, exact: sums of integers.
struct Differences {
  std::uint64_t samples = 0;       // compared
  std::uint64_t pixels = 0;        // that differ in any of them
  std::uint64_t sum = 0;           // of absolute differences
  std::uint64_t square_sum = 0;    // of squares
  std::uint32_t most = 0;          // the largest absolute one
  std::uint32_t full_scale = 255;  // 255 or 65535

  /// Of values scaled to [0, 1].
  double mean_absolute() const;
  double largest() const;
  double root_mean_square() const;
  /// 10 log10(1 / mean square) in dB; nothing when there is no difference.
  std::optional<double> psnr() const;
};

/// Over R, G and B of two pictures of one size and bit depth.
Differences color_differences(const Pixels&, const Pixels&);

/// |difference of alpha| in [0, 1] a pixel; a picture without alpha is opaque.
ErrorMap alpha_map(const Pixels&, const Pixels&);

/// 16 bits a sample, 8-bit ones times 257.
Pixels widened(const Pixels&);

}  // namespace lagomorph::render
