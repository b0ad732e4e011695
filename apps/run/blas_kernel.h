#pragma once

#include <string_view>

namespace lagomorph::apps {

/// What of the CPU kernels of OpenBLAS ask for.
struct VectorUnits {
  bool avx2_fma = false;
  bool avx512 = false;  // F, CD, BW, DQ and VL
};
VectorUnits vector_units();

/// The kernel that OpenBLAS should be told to take in place of the one that it `chose`, as OPENBLAS_CORETYPE
/// has it; empty where its own is right. It does not know CPUs that are newer than itself and then falls back
/// on kernels of 2004, a half to a third as fast.
std::string_view better_blas_kernel(std::string_view chosen, VectorUnits);

/// Begins the program anew, once, where OpenBLAS chose such a kernel and OPENBLAS_CORETYPE does not say
/// which: it reads that as it is loaded. Returns where there is nothing to do, or it cannot be done.
void restart_with_better_blas_kernel(char** argv);

}  // namespace lagomorph::apps
