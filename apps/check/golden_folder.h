#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/check/hashes.h"
#include "apps/check/picture_folder.h"

namespace lagomorph::apps {

/// What a golden holds: pictures, variants of them by platform, hashes.
struct GoldenFolder {
  std::filesystem::path root;
  PictureFolder own;                              // GOLDEN/frames, or GOLDEN itself
  std::map<std::string, PictureFolder> variants;  // GOLDEN/variants/NAME/frames
  std::map<int, PictureHash> hashes;              // of frames without a picture

  /// Every frame of which it knows anything.
  std::set<int> frames() const;
  /// Pictures to hold a frame against, the first being the one that counts when none passes: the named
  /// variant's alone where it has one, otherwise the golden's own, then every variant's.
  struct Candidate {
    std::filesystem::path picture;
    std::string variant;
  };
  std::vector<Candidate> candidates(int frame, const std::optional<std::string>& variant) const;
};

/// GOLDEN/variants/NAME/frames
std::filesystem::path variant_pictures(const std::filesystem::path& golden, const std::string& name);

/// Throws Error(wrong_input) when there is no such folder, or what is in it cannot be used.
GoldenFolder read_golden_folder(const std::filesystem::path& root);

}  // namespace lagomorph::apps
