#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/preview/material.h"
#include "apps/preview/shown.h"

namespace lagomorph::apps {

/// A short moving picture that was made.
struct Animation {
  std::filesystem::path file;  // name in the preview's folder
  Size size;
  std::size_t frames = 0;
  double rate = 0;  // [1/s]
  std::uintmax_t bytes = 0;
};

/// Makes animation.webp, or animation.mp4 where ffmpeg has no WebP, and animation.gif (at most 320 pixels
/// wide) of the small pictures, by ffmpeg; removes those of an earlier preview that are not made now. What
/// cannot be made is a remark of the material. The same pictures give the same bytes with the same ffmpeg.
std::vector<Animation> make_animations(PreviewMaterial&, const Shown&, const std::filesystem::path& out,
                                       const std::filesystem::path& work, const std::function<bool()>& stop);

}  // namespace lagomorph::apps
