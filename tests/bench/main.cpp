#include <benchmark/benchmark.h>

#include "apps/run/blas_kernel.h"

/// With the kernel of OpenBLAS that the program itself restarts with.
int main(int argc, char** argv) {
  lagomorph::apps::restart_with_better_blas_kernel(argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
