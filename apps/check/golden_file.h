#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/check/limits.h"
#include "apps/cli/options.h"

namespace lagomorph::apps {

/// Pixels that are not compared, in some frames.
struct MaskRule {
  std::optional<FrameRange> frames;  // none: all
  std::filesystem::path png;         // pixels brighter than half are left out; empty: the rectangle is
  render::Tile rectangle;            // [pixels]
  std::optional<int> body_id;        // instead: pixels of this body in the golden's own channel body_id
  std::string from;                  // where it stands
  bool applies_to(int frame) const { return !frames || (frames->first <= frame && frame <= frames->last); }
};

/// GOLDEN/golden.toml, with what the command line says over it.
class GoldenFile {
public:
  double pixels_per_degree = 0;
  bool ignore_extra = false;  // frames that only RUN has are no failure
  int keep_every = 1;         // approve keeps the pictures of every so many frames, of the others only hashes
  int states_every = 0;       // approve keeps the states of every so many frames, for telling causes; 0: none
  std::vector<MaskRule> masks;

  /// Of a frame.
  Limits limits(int frame) const;
  std::string preset(int frame) const;
  /// Where no range of frames says otherwise.
  Limits limits() const { return limits(-1); }
  std::string preset() const { return preset(-1); }

private:
  friend class GoldenReader;
  struct Rules {
    FrameRange frames = {-1, 0x7FFFFFFF};                       // -1 is no frame, and what is said of all
    std::optional<std::pair<std::string, std::string>> preset;  // and who chose it
    std::vector<std::pair<LimitName, LimitValue>> limits;
  };
  std::vector<Rules> rules_;  // the later wins
};

/// Reads GOLDEN/golden.toml; a golden without one has the defaults. `overrides` are KEY=VALUE of its keys and
/// stronger than it; `preset` is stronger than all of its limits. Throws Error(wrong_input) with the place.
GoldenFile read_golden_file(const std::filesystem::path& golden, std::span<const std::string> overrides,
                            const std::optional<std::string>& preset);

}  // namespace lagomorph::apps
