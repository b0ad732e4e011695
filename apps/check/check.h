#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/check/result.h"
#include "apps/progress/progress.h"

namespace lagomorph::apps {

/// What is to be checked, and how.
struct CheckRequest {
  std::filesystem::path run;
  std::filesystem::path golden;
  std::filesystem::path out;                // heat pictures go there
  std::optional<FrameRange> frames;         // only these
  std::vector<std::string> set;             // KEY=VALUE over golden.toml
  std::optional<std::string> preset;        // instead of its limits
  std::optional<std::string> variant;       // whose pictures come first
  std::optional<double> pixels_per_degree;  // instead of its
  bool needs_pair = true;                   // without any pair all is a mistake
  bool pictures = true;                     // write heat pictures
};

/// Holds every frame of the run against the golden's of its number, frames in parallel. The result but its
/// seconds is the same for any number of threads. Throws Error(wrong_input), with nothing written, when there
/// is no pair at all or RUN, GOLDEN or its golden.toml cannot be used.
CheckResult check_run(const CheckRequest&, Progress&);

}  // namespace lagomorph::apps
