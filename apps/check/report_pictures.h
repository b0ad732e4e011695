#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/check/result.h"

namespace lagomorph::apps {

/// Where a frame's pictures are for the page; empty: there is none.
struct ReportPictures {
  int frame = 0;
  std::string golden, fresh, heat;
  int width = 0, height = 0;  // of the picture itself
  int smaller = 1;            // by how much its copies are on the page
};

/// Keeps a picture's bytes and tells its URI: (name, type, bytes).
using KeepPicture = std::function<std::string(const std::string&, std::string_view, const std::string&)>;

/// The worst frames at full size as long as they fit, then small ones of others that differ, and of a few
/// key frames. At most 7 MB as base64.
std::vector<ReportPictures> report_pictures(const CheckResult&, const KeepPicture&);

}  // namespace lagomorph::apps
