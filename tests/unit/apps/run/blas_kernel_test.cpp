#include "apps/run/blas_kernel.h"

#include "sim/linear_solver.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

namespace lagomorph::tests {
namespace blas_kernel_test {

constexpr apps::VectorUnits none, avx2 = {.avx2_fma = true}, avx512 = {.avx2_fma = true, .avx512 = true};

TEST(BlasKernel, IsTheOneForTheVectorUnitsWhereOpenBlasFellBack) {
  for (const char* chosen : {"Prescott", "Core2", "Nehalem", "Barcelona", "Generic"}) {
    EXPECT_EQ(apps::better_blas_kernel(chosen, avx512), "SKYLAKEX") << chosen;
    EXPECT_EQ(apps::better_blas_kernel(chosen, avx2), "HASWELL") << chosen;
    EXPECT_EQ(apps::better_blas_kernel(chosen, none), "") << chosen;
  }
}

TEST(BlasKernel, IsOpenBlasOwnWhereItKnowsTheCpu) {
  for (const char* chosen : {"Haswell", "SkylakeX", "Zen", "Cooperlake", "neoversen1", ""})
    EXPECT_EQ(apps::better_blas_kernel(chosen, avx512), "") << chosen;
}

class BlasKernelOfARun : public ProgramRun {
protected:
  std::string kernel(const std::string& name, const std::map<std::string, std::string>& environment) {
    expect(0, simulate(name), {.environment = environment});
    return run_json(name).at("dependencies").at("blas_kernel");
  }
};

TEST_F(BlasKernelOfARun, IsWhatTheUserSays) {
  EXPECT_EQ(kernel("core2", {{"OPENBLAS_CORETYPE", "PRESCOTT"}}), "Prescott");
}

TEST_F(BlasKernelOfARun, IsNoStandInWhereTheCpuHasVectorUnits) {
  const std::string found = kernel("own", {});
  EXPECT_EQ(apps::better_blas_kernel(found, apps::vector_units()), "") << found;
}

/// Once is enough, whatever comes of it.
TEST_F(BlasKernelOfARun, IsChosenOnce) {
  const std::string own = sim::linear_algebra_info().blas_kernel;
  EXPECT_EQ(kernel("again", {{"LAGOMORPH_RESTARTED", "1"}}), own);
}

}  // namespace blas_kernel_test
}  // namespace lagomorph::tests
