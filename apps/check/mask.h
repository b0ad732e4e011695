#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "apps/check/golden_file.h"
#include "apps/check/result.h"
#include "render/pixels.h"

namespace lagomorph::apps {

/// The masks of a golden, their pictures read once.
class Masks {
public:
  /// Throws what reading the pictures throws.
  explicit Masks(std::span<const MaskRule>);

  /// Which pixels of a frame of this size are left out (1), rows from the top; empty when none are. `golden`
  /// is its picture there, beside which the channel body_id is. A mask that does not fit, or leaves nothing
  /// to compare, is told in `failures`.
  std::vector<std::uint8_t> of(int frame, const std::filesystem::path& golden, int width, int height,
                               std::vector<CheckFailure>& failures) const;

private:
  std::span<const MaskRule> rules_;
  std::map<std::filesystem::path, render::Pixels> pictures_;
};

/// Gives `fresh` the golden's samples where the mask is set, so that nothing is found there. Both of one
/// kind.
void cover(const std::vector<std::uint8_t>& mask, const render::Pixels& golden, render::Pixels& fresh);

/// Share of pixels that are set, in [0, 1].
double masked_share(const std::vector<std::uint8_t>& mask);

}  // namespace lagomorph::apps
