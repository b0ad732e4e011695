#include "render/path/tile_means.h"

#include <cstddef>
#include <limits>

namespace lagomorph::render::path {

void BatchedMean::add(const Color& sample) {
  if (batches_ == 0 || in_last_ == batch_size_) {
    if (batches_ == most_batches) {
      for (std::size_t i = 0; i < most_batches / 2; ++i) sums_[i] = sums_[2 * i] + sums_[2 * i + 1];
      batches_ /= 2;
      batch_size_ *= 2;
    }
    sums_[static_cast<std::size_t>(batches_++)].setZero();
    in_last_ = 0;
  }
  sums_[static_cast<std::size_t>(batches_ - 1)] += sample.cast<double>();
  ++in_last_;
}

Eigen::Array3d BatchedMean::variance() const {
  if (batches_ < 2) return Eigen::Array3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const double count = static_cast<double>(batches_ - 1) * batch_size_ + in_last_;
  const auto size = [&](int batch) { return batch + 1 < batches_ ? batch_size_ : in_last_; };
  Eigen::Array3d mean = Eigen::Array3d::Zero();
  for (int b = 0; b < batches_; ++b) mean += sums_[static_cast<std::size_t>(b)] / count;
  Eigen::Array3d spread = Eigen::Array3d::Zero();
  for (int b = 0; b < batches_; ++b)
    spread += size(b) / count * (sums_[static_cast<std::size_t>(b)] / size(b) - mean).square();
  return spread / (batches_ - 1.0);
}

TileMeans::TileMeans(const Tile& tile, const MeanChannels& channels, int picture_width)
    : tile_(tile), channels_(channels), picture_width_(picture_width) {
  pixels_.resize(static_cast<std::size_t>(tile.x1 - tile.x0) * static_cast<std::size_t>(tile.y1 - tile.y0));
  if (channels.variance != nullptr) colors_.resize(pixels_.size());
}

void TileMeans::add(int x, int y, const Color& radiance, const FirstHit& hit) {
  const auto at = static_cast<std::size_t>((y - tile_.y0) * (tile_.x1 - tile_.x0) + x - tile_.x0);
  if (!colors_.empty()) colors_[at].add(radiance);
  Pixel& p = pixels_[at];
  const auto opacity = static_cast<double>(hit.opacity);
  p.albedo += opacity * hit.albedo.cast<double>();
  p.normal += opacity * hit.normal.cast<double>();
  p.depth += opacity * static_cast<double>(hit.depth);
  p.opacity += opacity;
  if (hit.catches && !hit.on_light) {
    p.catches += opacity;
    p.light += static_cast<double>(hit.light);
    p.reached += static_cast<double>(hit.reached);
  } else {
    p.alpha += hit.on_light ? 1.0 : opacity;
  }
  ++p.samples;
}

void TileMeans::write() const {
  std::size_t i = 0;
  for (int y = tile_.y0; y < tile_.y1; ++y) {
    for (int x = tile_.x0; x < tile_.x1; ++x, ++i) {
      const Pixel& p = pixels_[i];
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_width_) +
                      static_cast<std::size_t>(x);
      const auto put = [&](float* channel, const Eigen::Array3d& value) {
        if (channel == nullptr) return;
        for (std::size_t k = 0; k < 3; ++k)
          channel[3 * at + k] = static_cast<float>(value[static_cast<Eigen::Index>(k)]);
      };
      put(channels_.albedo, p.albedo / p.samples);
      put(channels_.normal, p.normal.array() / p.samples);
      if (channels_.depth != nullptr) {
        channels_.depth[at] = p.opacity > 0.0 ? static_cast<float>(p.depth / p.opacity)
                                              : std::numeric_limits<float>::infinity();
      }
      if (channels_.alpha != nullptr) {
        const double taken = p.light > 0.0 ? 1.0 - p.reached / p.light : 0.0;
        channels_.alpha[at] = static_cast<float>((p.alpha + p.catches * taken) / p.samples);
      }
      if (!colors_.empty()) put(channels_.variance, colors_[i].variance());
    }
  }
}

}  // namespace lagomorph::render::path
