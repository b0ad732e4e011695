#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "sim/solve_counts.h"

namespace lagomorph::apps {

/// By what linear systems were solved, which solver.linear = "auto" chooses: "conjugate gradients", "Cholesky
/// factorizations", or one and then the other; empty where none was solved.
std::string way_text(const sim::SolveCounts&);
/// The same with their numbers: "1204 iterations of conjugate gradients, no factorization".
std::string solves_text(const sim::SolveCounts&);
/// The numbers alone.
nlohmann::ordered_json solves_json(const sim::SolveCounts&);

}  // namespace lagomorph::apps
