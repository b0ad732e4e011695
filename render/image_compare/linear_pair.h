#pragma once

#include <cstddef>
#include <memory>

#include "render/pixels.h"

namespace lagomorph::render {

/// Two pictures of one size as linear RGB in [0, 1], by rows: what FLIP compares.
class LinearPair {
public:
  LinearPair(int width, int height) : width_(width), height_(height) {}
  virtual ~LinearPair() = default;
  LinearPair(const LinearPair&) = delete;
  LinearPair& operator=(const LinearPair&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }

  /// `count` pixels of row y from column x on, of the first picture (which = 0) or the second (1).
  virtual void read(int which, int y, int x, int count, float* red, float* green, float* blue) const = 0;
  /// Whether these pixels are the same in both, to the bit.
  virtual bool same(int y, int x, int count) const = 0;

private:
  int width_;
  int height_;
};

/// Of decoded pictures of one size and bit depth; alpha is left out. They must outlive the pair.
std::unique_ptr<LinearPair> linear_pair(const Pixels& first, const Pixels& second);

}  // namespace lagomorph::render
