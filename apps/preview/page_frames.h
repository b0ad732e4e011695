#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/preview/shown.h"

namespace lagomorph::apps {

/// A frame that the page holds.
struct PageFrame {
  int frame = 0;
  std::string uri;  // its picture
};

/// The readable frames as WebP by ffmpeg, where there is one, otherwise as PNGs at most 320 pixels wide; so
/// few of them, evenly, that they take at most 6 MB.
std::vector<PageFrame> page_frames(const Shown&, const std::filesystem::path& work,
                                   const std::function<bool()>& stop);

}  // namespace lagomorph::apps
