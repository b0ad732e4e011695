#pragma once

#include <filesystem>
#include <vector>

namespace lagomorph::apps {

/// A golden of a frame that the run does not have.
struct StaleGolden {
  int frame = 0;
  std::filesystem::path file;  // a picture, or a state kept with one; empty: a hash
};

/// All of them, ascending; those of variants too. Throws Error(wrong_input) when RUN has no picture at
/// all: then it is the run that is wrong.
std::vector<StaleGolden> stale_goldens(const std::filesystem::path& run, const std::filesystem::path& golden);

/// Deletes them.
void prune(const std::filesystem::path& golden, const std::vector<StaleGolden>&);

}  // namespace lagomorph::apps
