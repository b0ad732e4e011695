#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "render/simd.h"

/// Sample numbers of the path tracer: Owen-scrambled Sobol pairs [Burley 2020, "Practical Hash-based Owen
/// Scrambling"], one pair of dimensions padded to another by shuffling the index. A number is a function of
/// (seed, frame, pixel, samples a pixel, sample, dimension) and of nothing else.
namespace lagomorph::render::path {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffU) << 8) | ((x & 0xff00ff00U) >> 8);
  x = ((x & 0x0f0f0f0fU) << 4) | ((x & 0xf0f0f0f0U) >> 4);
  x = ((x & 0x33333333U) << 2) | ((x & 0xccccccccU) >> 2);
  x = ((x & 0x55555555U) << 1) | ((x & 0xaaaaaaaaU) >> 1);
  return x;
}

/// A hash in which a bit changes higher bits only: on reversed bits, an Owen scramble [Laine and Karras 2011;
/// the constants are Vegdahl's, 2021].
constexpr std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

/// The second Sobol dimension of index i with its bits reversed: bit j is the sum (mod 2) of the bits k of i
/// with C(k, j) odd, that is with j a subset of k.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t i) {
  i ^= (i & 0xaaaaaaaaU) >> 1;
  i ^= (i & 0xccccccccU) >> 2;
  i ^= (i & 0xf0f0f0f0U) >> 4;
  i ^= (i & 0xff00ff00U) >> 8;
  i ^= i >> 16;
  return i;
}

/// splitmix64's output function.
constexpr std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

struct Pair {
  float u, v;  // in [0, 1)
};

/// What scrambles a dimension.
struct PairKeys {
  std::uint32_t shuffle, u, v;
};
constexpr PairKeys pair_keys(std::uint64_t key, std::uint32_t dimension) {
  const std::uint64_t a = mix(key + 0x9e3779b97f4a7c15ULL * (dimension + 1ULL));
  const std::uint64_t b = mix(a + 0x9e3779b97f4a7c15ULL);
  return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32), static_cast<std::uint32_t>(b)};
}
/// In [0, 1): the first 24 bits.
constexpr float unit_of(std::uint32_t bits) {
  return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24F;
}
/// The pair of a dimension, of a path by its index with the bits reversed.
LAGOMORPH_INLINE constexpr Pair pair_of(const PairKeys& keys, std::uint32_t reversed_index) {
  const std::uint32_t index = reverse_bits(laine_karras(reversed_index, keys.shuffle));
  const std::uint32_t u = reverse_bits(laine_karras(index, keys.u));
  const std::uint32_t v = reverse_bits(laine_karras(sobol_second_reversed(index), keys.v));
  return {unit_of(u), unit_of(v)};
}

/// A path's index with its bits reversed.
struct SampleNumber {
  std::uint32_t reversed_index;
};

/// The numbers of one path.
class PathSamples {
public:
  PathSamples() = default;
  PathSamples(std::uint64_t key, std::uint32_t index) : key_(key), reversed_index_(reverse_bits(index)) {}
  PathSamples(std::uint64_t key, SampleNumber number) : key_(key), reversed_index_(number.reversed_index) {}

  /// The pair of a dimension; dimensions are names only, in any order and with gaps.
  Pair pair(std::uint32_t dimension) const { return pair_of(pair_keys(key_, dimension), reversed_index_); }

  /// Those of neighbours are alike.
  std::uint64_t key() const { return key_; }
  std::uint32_t number() const { return reversed_index_; }

private:
  std::uint64_t key_ = 0;
  std::uint32_t reversed_index_ = 0;
};

/// Gives every path of a frame its numbers. The pixels of a block of 128 x 128 share one sequence in Z order,
/// so that the errors of neighbours cancel and the noise that is left is fine [Ahmed and Wonka 2020]. Every
/// frame has another sequence, as in film: a constant one would stand before the moving picture like a dirty
/// pane.
class FrameSamples {
public:
  FrameSamples(std::uint32_t seed, int frame, int samples)
      : key_(mix((static_cast<std::uint64_t>(seed) << 32) + static_cast<std::uint32_t>(frame) + 1ULL)),
        sample_bits_(std::bit_width(static_cast<std::uint32_t>(samples - 1))) {}

  PathSamples path(int x, int y, int sample) const { return {key(x, y), index(pixel(x, y), sample)}; }

  /// The same in parts: the key of a block's pixels, a pixel's place there, and the index of a path.
  std::uint64_t key(int x, int y) const {
    const std::uint64_t block =
        (static_cast<std::uint64_t>(y >> 7) << 32) | static_cast<std::uint32_t>(x >> 7);
    return mix(key_ + block);
  }
  static std::uint32_t pixel(int x, int y) {
    return spread(static_cast<std::uint32_t>(x) & 127U) | (spread(static_cast<std::uint32_t>(y) & 127U) << 1);
  }
  std::uint32_t index(std::uint32_t pixel, int sample) const {
    return (pixel << sample_bits_) | static_cast<std::uint32_t>(sample);
  }

private:
  /// A zero between the bits of a byte.
  static constexpr std::uint32_t spread(std::uint32_t x) {
    x = (x | (x << 4)) & 0x0f0fU;
    x = (x | (x << 2)) & 0x3333U;
    return (x | (x << 1)) & 0x5555U;
  }

  std::uint64_t key_;
  int sample_bits_;  // 0 .. 16, so that index has 30 bits at most
};

}  // namespace lagomorph::render::path
