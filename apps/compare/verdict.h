#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/image_compare/compare.h"
#include "render/image_compare/gate.h"
#include "render/pixels.h"

namespace lagomorph::apps {

/// What `compare` finds out of two pictures.
struct PairVerdict {
  std::vector<render::GateFailure> failures;     // rules of the default gate that are broken
  std::optional<render::Comparison> comparison;  // none of pictures of different sizes
  bool same() const { return failures.empty(); }
};

/// Throws SettingsError for a bad `pixels_per_degree`.
PairVerdict judge_pair(const render::Pixels& a, const render::Pixels& b, double pixels_per_degree);

/// The contract's JSON object on one line; of pictures of different sizes every figure is null.
std::string verdict_json(const PairVerdict&);

/// The verdict, what it rests on and the figures, for people. `a` and `b` are the pictures' names.
std::string verdict_text(const PairVerdict&, const std::string& a, const std::string& b,
                         double pixels_per_degree);

}  // namespace lagomorph::apps
