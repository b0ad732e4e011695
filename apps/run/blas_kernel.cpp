#include "apps/run/blas_kernel.h"

#include <array>
#include <cstdlib>

#include <unistd.h>

#include "sim/linear_solver.h"

namespace lagomorph::apps {
namespace {

constexpr const char* wish = "OPENBLAS_CORETYPE";
constexpr const char* restarted = "LAGOMORPH_RESTARTED";  // against doing so forever
/// Kernels of SSE that stand in for CPUs that OpenBLAS does not know, by openblas_get_corename().
constexpr std::array<std::string_view, 6> stand_ins = {"Generic", "Prescott",  "Core2",
                                                       "Nehalem", "Barcelona", "Opteron"};

}  // namespace

VectorUnits vector_units() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  return {.avx2_fma = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0,
          .avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
                    __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                    __builtin_cpu_supports("avx512vl") != 0};
#else
  return {};
#endif
}

std::string_view better_blas_kernel(std::string_view chosen, VectorUnits units) {
  for (const std::string_view stand_in : stand_ins) {
    if (chosen != stand_in) continue;
    if (units.avx512) return "SKYLAKEX";
    if (units.avx2_fma) return "HASWELL";
  }
  return {};
}

void restart_with_better_blas_kernel(char** argv) {
  if (std::getenv(wish) != nullptr || std::getenv(restarted) != nullptr) return;
  const std::string_view better = better_blas_kernel(sim::blas_kernel(), vector_units());
  if (better.empty()) return;
  if (setenv(wish, better.data(), 1) != 0 || setenv(restarted, "1", 1) != 0) return;
  execv("/proc/self/exe", argv);
  // Not there or not allowed: this one does, only slower.
  unsetenv(wish);
  unsetenv(restarted);
}

}  // namespace lagomorph::apps
