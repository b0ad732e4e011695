#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// Light along the rays through the pixels of a tile.
class RaySamples {
public:
  static constexpr int fewest = 4, most = 16;  // a pixel; OpenGL's samples, and those with twelve around them

  /// `first`: samples that every pixel takes, `fewest` or `most`.
  RaySamples(std::size_t pixels, int first);

  /// Where sample k of a pixel is in it.
  static Vec2 place(int k);
  /// How many samples a pixel takes.
  int count(std::size_t pixel) const { return counts_[pixel]; }
  /// Pixels whose first samples are unlike each other take all.
  void want_more();

  Color& light(std::size_t pixel, std::size_t sample) { return lights_[pixel * most + sample]; }
  /// A sample that sees something that is drawn by rays.
  void meet(std::size_t pixel, std::size_t sample) {
    met_[pixel] = static_cast<std::uint16_t>(met_[pixel] | 1U << sample);
  }
  /// Mean of the samples that meet something, times the part of OpenGL's that do. Unless `evenly`, samples
  /// brighter than 1 count less by as much, so that a lamp that a few of them meet is no spark.
  Color mean(std::size_t pixel, bool evenly) const;

private:
  int first_;
  std::vector<Color> lights_;  // of each pixel and sample
  std::vector<std::uint16_t> met_;
  std::vector<int> counts_;
};

}  // namespace lagomorph::render::raster
