#pragma once

#include <cstdint>

namespace lagomorph::sim {

/// How linear systems were solved.
struct SolveCounts {
  std::int64_t factorizations = 0;
  std::int64_t cg_iterations = 0;      // preconditioned by the diagonal's blocks
  std::int64_t factor_iterations = 0;  // preconditioned by the factor of another matrix

  SolveCounts& operator+=(const SolveCounts& other) {
    factorizations += other.factorizations;
    cg_iterations += other.cg_iterations;
    factor_iterations += other.factor_iterations;
    return *this;
  }
  SolveCounts operator-(const SolveCounts& before) const {
    return {factorizations - before.factorizations, cg_iterations - before.cg_iterations,
            factor_iterations - before.factor_iterations};
  }
  bool operator==(const SolveCounts&) const = default;
};

}  // namespace lagomorph::sim
