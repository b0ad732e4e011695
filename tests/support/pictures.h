#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/png_read.h"
#include "tests/support/paths.h"

/// Pictures for comparing: those of tests/data/flip, and noise.
namespace lagomorph::render::tests {

inline std::string flip_path(const std::string& name) {
  return lagomorph::tests::source_dir().string() + "/tests/data/flip/" + name;
}

inline std::string file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline Pixels flip_picture(const std::string& name) {
  return read_png(file_bytes(flip_path("png/" + name)), name);
}

/// Smooth colours with a grain of `grain` in 255.
inline Pixels grainy(int width, int height, std::uint32_t seed, unsigned grain = 64) {
  std::vector<std::uint8_t> samples;
  std::uint32_t state = seed;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        state = state * 1664525U + 1013904223U;
        const int smooth = (2 * x * (c + 1) + 3 * y + 60 * c) % 190;
        samples.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(smooth) + (state >> 16U) % grain));
      }
    }
  }
  return {.width = width, .height = height, .samples = samples};
}

inline std::vector<std::uint8_t>& bytes_of(Pixels& pixels) {
  return std::get<std::vector<std::uint8_t>>(pixels.samples);
}
inline const std::vector<std::uint8_t>& bytes_of(const Pixels& pixels) {
  return std::get<std::vector<std::uint8_t>>(pixels.samples);
}

}  // namespace lagomorph::render::tests
