#include "apps/run/solves_text.h"

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lagomorph::apps {

std::string way_text(const sim::SolveCounts& solves) {
  std::string text;
  if (solves.cg_iterations > 0) text = "conjugate gradients";
  const char* const factors = solves.factorizations > 0      ? "Cholesky factorizations"
                              : solves.factor_iterations > 0 ? "a Cholesky factorization at rest"
                                                             : "";
  if (*factors != '\0') text += (text.empty() ? "" : " and ") + std::string(factors);
  return text;
}

std::string solves_text(const sim::SolveCounts& solves) {
  if (solves.cg_iterations + solves.factorizations + solves.factor_iterations == 0) return "none";
  std::string text;
  if (solves.cg_iterations > 0)
    text = fmt::format("{} iterations of conjugate gradients, ", solves.cg_iterations);
  text += solves.factorizations == 0 ? "no factorization"
                                     : fmt::format("{} factorizations", solves.factorizations);
  if (solves.factor_iterations > 0)
    text += fmt::format(" and {} iterations with a factor kept", solves.factor_iterations);
  return text;
}

nlohmann::ordered_json solves_json(const sim::SolveCounts& solves) {
  return {{"factorizations", solves.factorizations},
          {"cg_iterations", solves.cg_iterations},
          {"factor_iterations", solves.factor_iterations}};
}

}  // namespace lagomorph::apps
