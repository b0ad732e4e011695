#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "render/raster/receivers.h"

namespace lagomorph::render::raster {

/// What one point sees: the part of each of four lights, then of the sky's colours, then of those mirrored.
constexpr std::size_t first_sky = 4, first_mirrored = 7, seen_parts = 10;
using SeenParts = std::array<float, seen_parts>;

/// What one pixel of each quad sees, to be shared by all four where shadows are wide and the surface goes on:
/// a quarter of the lookups. Between quads it is bilinear.
class QuadParts {
public:
  /// All is seen, of lights and sky, of quads with their receivers (blocks of quads, with a border).
  explicit QuadParts(const ReceiverBlocks&);

  int width() const { return width_; }
  int height() const { return height_; }
  SeenParts& at(int x, int y) { return parts_[index(x, y)]; }
  /// When all is put: finds where it is not smooth.
  void finish(const ReceiverBlocks&);

  /// What pixel (x, y) from the lower left pixel of quad (0, 0) sees; returns false where its quads do not
  /// say it: they see too different parts, or other surfaces. `depth` and `normal` are the pixel's own,
  /// `reach` the difference in depth within which the surface goes on [m].
  bool find(int x, int y, float depth, const Vec3& normal, float reach, SeenParts& seen) const;

private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  struct Surface {
    Vec3 normal;
    float depth;  // [m]; 1e9 where nothing is
  };
  int width_, height_;
  std::vector<SeenParts> parts_;
  std::vector<Surface> surfaces_;
  std::vector<char> rough_;  // 1: with its neighbours to the right and above
};

}  // namespace lagomorph::render::raster
