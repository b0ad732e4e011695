#pragma once

#include <string>

#include "apps/cli/options.h"
#include "apps/error.h"
#include "render/image_compare/hdr_flip.h"

namespace lagomorph::apps {

/// Whether a name is that of a float channel: it ends in .npy.
bool is_float_channel(const std::string& file);

/// A float32 array of shape (H, W), (H, W, 1) or (H, W, 3) as a picture; one value a pixel is grey. Throws
/// Error(wrong_input) for anything else.
render::FloatPicture read_float_picture(const std::string& file);

/// `compare A.npy B.npy`: two float channels (RUN/aov/color/...) by HDR-FLIP and plain differences, A being
/// the reference. The figures are those of pictures, but for psnr and ssim, which are none: rmse and max_abs
/// are in the channel's own unit, over values that are finite in both.
ExitStatus compare_floats(const Options&);

}  // namespace lagomorph::apps
