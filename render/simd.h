#pragma once

/// A function marked with it is compiled for several instruction sets, and the processor's best is taken when
/// the program starts (as in sim/simd.h, of which the renderers know nothing).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define LAGOMORPH_RENDER_SIMD __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define LAGOMORPH_RENDER_SIMD
#endif

/// Loops over lanes become vector instructions where they are inlined into functions of several instruction
/// sets.
#define LAGOMORPH_INLINE inline __attribute__((always_inline))

/// Before a loop whose rows are in memory of their own: no element depends on another.
#ifdef __clang__
#define LAGOMORPH_ROWS _Pragma("clang loop vectorize(assume_safety)")
#else
#define LAGOMORPH_ROWS _Pragma("GCC ivdep")
#endif
