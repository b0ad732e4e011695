#pragma once

/// A function marked with it is compiled for several instruction sets, and the processor's best is taken when
/// the program starts: what is distributed runs anywhere, and nobody has to build for his machine. Sums may
/// differ in their last bits from one kind of machine to another, as those of OpenBLAS do; on one they are
/// always the same.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define LAGOMORPH_SIMD __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define LAGOMORPH_SIMD
#endif
