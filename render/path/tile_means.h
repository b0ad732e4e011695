#pragma once

#include <array>
#include <vector>

#include "render/path/path_tracer.h"
#include "render/types.h"

namespace lagomorph::render::path {

/// Sums of a pixel's samples in at most 8 batches of consecutive ones, as many to a batch, by which the
/// variance of their mean is told; the last batch may be smaller. Samples of a low-discrepancy sequence are
/// not independent: the variance between single ones over their number would be far too large, while batches
/// are small nets themselves; see TileStatistics. What is told is the true
/// variance or more: twice it, in the mean over a picture with 64 samples.
class BatchedMean {
public:
  void add(const Color& sample);
  /// NaN of one sample.
  Eigen::Array3d variance() const;

private:
  static constexpr int most_batches = 8;

  std::array<Eigen::Array3d, most_batches> sums_;
  int batches_ = 0;
  int batch_size_ = 1;
  int in_last_ = 0;  // samples of the last batch
};

/// Where means over a pixel's samples go: channels of the whole picture, see channels.h; nullptr: not wanted.
struct MeanChannels {
  float* albedo = nullptr;    // 3 a pixel
  float* normal = nullptr;    // 3
  float* depth = nullptr;     // 1
  float* variance = nullptr;  // 3
  float* alpha = nullptr;     // 1
  bool any() const {
    return albedo != nullptr || normal != nullptr || depth != nullptr || variance != nullptr ||
           alpha != nullptr;
  }
};

/// Those means of one tile's pixels. Sums go in the order of the calls.
class TileMeans {
public:
  TileMeans(const Tile&, const MeanChannels&, int picture_width);

  void add(int x, int y, const Color& radiance, const FirstHit&);
  void write() const;

private:
  struct Pixel {
    Eigen::Array3d albedo = Eigen::Array3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double depth = 0.0;
    double opacity = 0.0;
    double alpha = 0.0;
    double catches = 0.0, light = 0.0, reached = 0.0;  // of a shadow catcher
    int samples = 0;
  };

  Tile tile_;
  MeanChannels channels_;
  int picture_width_;
  std::vector<Pixel> pixels_;
  std::vector<BatchedMean> colors_;  // where the variance is wanted
};

}  // namespace lagomorph::render::path
