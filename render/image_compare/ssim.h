#pragma once

#include <optional>

#include "render/image_compare/lanes.h"
#include "render/pixels.h"

namespace lagomorph::render {

/// The least width and height that SSIM has a window for.
inline constexpr int ssim_window = 11;

/// The mean structural similarity over R, G and B of two pictures of one size and bit depth [Wang 2004,
/// "Image quality assessment: from error visibility to structural similarity", Eq. 13]: sRGB samples scaled
/// to [0, 255], windows of 11x11 pixels with Gaussian weights of sigma 1.5, K1 = 0.01, K2 = 0.03, population
/// covariances, only windows that are wholly inside. Nothing under 11 pixels of width or height. The same
/// bits for any number of threads and any instruction set.
std::optional<double> ssim(const Pixels&, const Pixels&, InstructionSet = widest_instruction_set());

}  // namespace lagomorph::render
