#pragma once

#include <cstddef>

#include "render/simd.h"

/// Rows of floats, several at a time. One body of code is compiled for the base instruction set and for AVX2
/// and chosen at run time; both give the same bits, since neither contracts or reorders anything.
namespace lagomorph::render {

#if defined(__x86_64__)
#define LAGOMORPH_AVX2 __attribute__((target("avx2")))
#else
#define LAGOMORPH_AVX2
#endif
// LAGOMORPH_INLINE: the bodies, inlined into each of their two instantiations.

/// `n` floats at any address.
template <std::size_t n>
struct LanesOf;
template <>
struct LanesOf<4> {
  using Type [[gnu::vector_size(16), gnu::aligned(4), gnu::may_alias]] = float;
};
template <>
struct LanesOf<8> {
  using Type [[gnu::vector_size(32), gnu::aligned(4), gnu::may_alias]] = float;
};
template <std::size_t n>
using Lanes = typename LanesOf<n>::Type;

// References, since eight lanes by value would be passed in different ways by the two instruction sets.
template <std::size_t n>
LAGOMORPH_INLINE const Lanes<n>& load(const float* p) {
  return *reinterpret_cast<const Lanes<n>*>(p);
}
template <std::size_t n>
LAGOMORPH_INLINE void store(float* p, const Lanes<n>& value) {
  *reinterpret_cast<Lanes<n>*>(p) = value;
}

/// Filters make two neighbouring lanes at a time.
template <std::size_t n>
inline constexpr std::size_t block = 2 * n;
/// Rows are rounded up to the larger block.
inline constexpr std::size_t whole_blocks(std::size_t count) {
  constexpr std::size_t most = block<8>;
  return (count + most - 1) / most * most;
}

enum class InstructionSet { base, avx2 };

/// The widest that this processor has.
inline InstructionSet widest_instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::base;
}

}  // namespace lagomorph::render
