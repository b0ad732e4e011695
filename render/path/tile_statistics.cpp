#include "render/path/tile_statistics.h"

#include <algorithm>
#include <limits>

namespace lagomorph::render::path {
namespace {

int cells(int pixels) { return (pixels + statistics_cell - 1) / statistics_cell; }

}  // namespace

TileStatistics::TileStatistics(const Tile& tile, int samples)
    : tile_(tile),
      samples_(samples),
      batches_(std::min(samples, most_batches)),
      columns_(cells(tile.x1 - tile.x0)) {
  const std::size_t n = static_cast<std::size_t>(columns_) *
                        static_cast<std::size_t>(cells(tile.y1 - tile.y0)) *
                        static_cast<std::size_t>(batches_);
  sums_.assign(n, Eigen::Array3d::Zero());
  counts_.assign(n, 0);
}

void TileStatistics::add(int x, int y, int sample, const Color& radiance) {
  const int cell = (y - tile_.y0) / statistics_cell * columns_ + (x - tile_.x0) / statistics_cell;
  const std::size_t i = static_cast<std::size_t>(cell) * static_cast<std::size_t>(batches_) +
                        static_cast<std::size_t>(sample * batches_ / samples_);
  sums_[i] += radiance.cast<double>();
  ++counts_[i];
}

void TileStatistics::write(int picture_width, float* channel) const {
  const auto n = static_cast<std::size_t>(batches_);
  for (std::size_t cell = 0; cell * n < sums_.size(); ++cell) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    int count = 0;
    for (std::size_t b = 0; b < n; ++b) {
      sum += sums_[cell * n + b];
      count += counts_[cell * n + b];
    }
    const Eigen::Array3d mean = sum / count;
    // Batches weigh as they have samples, which differ by one a pixel where their number does not divide.
    Eigen::Array3d spread = Eigen::Array3d::Zero();
    for (std::size_t b = 0; b < n; ++b) {
      const double weight = static_cast<double>(counts_[cell * n + b]) / count;
      const Eigen::Array3d off = sums_[cell * n + b] / counts_[cell * n + b] - mean;
      spread += weight * off.square();
    }
    const Eigen::Array3d variance = spread / (batches_ - 1.0);  // NaN of one batch
    const int column = tile_.x0 / statistics_cell + static_cast<int>(cell) % columns_;
    const int row = tile_.y0 / statistics_cell + static_cast<int>(cell) / columns_;
    float* out = channel + static_cast<std::ptrdiff_t>(statistics_components) *
                               (static_cast<std::ptrdiff_t>(row) * cells(picture_width) + column);
    for (int k = 0; k < 3; ++k) {
      out[k] = static_cast<float>(mean[k]);
      out[3 + k] = static_cast<float>(variance[k]);
    }
    out[6] = static_cast<float>(batches_);
    out[7] = static_cast<float>(samples_);
  }
}

}  // namespace lagomorph::render::path
