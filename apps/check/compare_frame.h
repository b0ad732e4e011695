#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/check/limits.h"
#include "apps/check/mask.h"
#include "apps/check/result.h"
#include "render/image_compare/bias.h"
#include "render/pixels.h"

namespace lagomorph::apps {

/// What is held against what.
struct FramePair {
  int frame = 0;
  std::filesystem::path golden;  // both are there
  std::filesystem::path fresh;
  std::string variant;
};

/// What is told, and what only the sequence and the pictures need.
struct ComparedFrame {
  FrameResult result;
  render::TileBias bias;                 // no size where nothing was compared
  std::optional<render::Pixels> golden;  // decoded; only of a frame that fails by its figures
  std::optional<render::Pixels> fresh;   // likewise; the masked pixels are the golden's
  std::optional<render::ErrorMap> flip;  // likewise
};

/// Judges a frame from the bytes on disk: equal files without decoding, equal samples without metrics. What
/// cannot be compared is a failure, never an exception.
ComparedFrame compare_frame(const FramePair&, const Limits&, const Masks&, double pixels_per_degree);

}  // namespace lagomorph::apps
