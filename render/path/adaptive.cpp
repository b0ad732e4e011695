#include "render/path/adaptive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lagomorph::render::path {
namespace {

constexpr int cell_size = 8;                // [pixels]
constexpr std::size_t most_pending = 4096;  // samples traced in one go
constexpr double dark = 1e-4;               // luminance below which noise counts as that much light's

struct Pixel {
  int x, y;
  Eigen::Array3d before = Eigen::Array3d::Zero();  // sum of the samples before the last round
  Eigen::Array3d last = Eigen::Array3d::Zero();    // and of the last round
};

/// The squares' pixels, one square after the other.
using Cell = std::vector<Pixel>;

std::vector<Cell> cells_of(const Tile& tile) {
  std::vector<Cell> cells;
  for (int y0 = tile.y0; y0 < tile.y1; y0 += cell_size) {
    for (int x0 = tile.x0; x0 < tile.x1; x0 += cell_size) {
      Cell& cell = cells.emplace_back();
      for (int y = y0; y < std::min(y0 + cell_size, tile.y1); ++y) {
        for (int x = x0; x < std::min(x0 + cell_size, tile.x1); ++x) cell.push_back({.x = x, .y = y});
      }
    }
  }
  return cells;
}

/// Adds samples from..to-1 to the cells' last round.
void sample_round(PathTracer& tracer, const FrameSamples& numbers, const std::vector<Cell*>& active, int from,
                  int to, TileMeans* means) {
  std::vector<PathTracer::PixelSample> pending;
  std::vector<Pixel*> owners;
  std::vector<Color> radiance;
  const auto flush = [&] {
    radiance.resize(pending.size());
    tracer.trace(pending, numbers, radiance, means);
    for (std::size_t i = 0; i < pending.size(); ++i) owners[i]->last += radiance[i].cast<double>();
    pending.clear();
    owners.clear();
  };
  for (Cell* cell : active) {
    for (Pixel& pixel : *cell) {
      pixel.before += pixel.last;
      pixel.last.setZero();
      for (int sample = from; sample < to; ++sample) {
        pending.push_back({pixel.x, pixel.y, sample});
        owners.push_back(&pixel);
        if (pending.size() == most_pending) flush();
      }
    }
  }
  flush();
}

/// Of `before` first samples and `last` in the last round.
bool is_done(const Cell& cell, int before, int last, double threshold) {
  const double all = before + last;
  double variance = 0.0;  // of a pixel's mean, summed over pixels and colours
  double luminance = 0.0;
  for (const Pixel& p : cell) {
    const Eigen::Array3d off = p.before / before - p.last / last;
    variance += off.square().sum() * before * last / (all * all);
    const Eigen::Array3d mean = (p.before + p.last) / all;
    luminance += 0.2126 * mean[0] + 0.7152 * mean[1] + 0.0722 * mean[2];
  }
  const auto pixels = static_cast<double>(cell.size());
  return variance / (3.0 * pixels) <= threshold * threshold * std::max(luminance / pixels, dark);
}

}  // namespace

void trace_adaptively(PathTracer& tracer, const Tile& tile, const FrameSamples& numbers,
                      const AdaptiveSampling& s, int picture_width, float* color, float* counts,
                      TileMeans* means) {
  std::vector<Cell> cells = cells_of(tile);
  std::vector<Cell*> active;
  active.reserve(cells.size());
  for (Cell& cell : cells) active.push_back(&cell);
  int before = 0;
  int next = std::min((s.min_samples + 1) / 2, s.max_samples);
  while (!active.empty()) {
    sample_round(tracer, numbers, active, before, next, means);
    const bool last = next == s.max_samples;
    std::erase_if(active, [&](Cell* cell) {
      const bool done = last || (before > 0 && is_done(*cell, before, next - before, s.threshold));
      for (const Pixel& p : *cell) {
        if (!done) break;
        const auto at = static_cast<std::size_t>(p.y) * static_cast<std::size_t>(picture_width) +
                        static_cast<std::size_t>(p.x);
        for (int k = 0; k < 3; ++k)
          color[3 * at + static_cast<std::size_t>(k)] = static_cast<float>((p.before[k] + p.last[k]) / next);
        if (counts != nullptr) counts[at] = static_cast<float>(next);
      }
      return done;
    });
    before = next;
    next = static_cast<int>(std::min<std::int64_t>(2LL * next, s.max_samples));
  }
}

}  // namespace lagomorph::render::path
