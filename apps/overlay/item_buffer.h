#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/camera.h"
#include "render/types.h"

namespace lagomorph::apps {

/// A point of the world as a camera sees it.
struct ViewPoint {
  double x = 0, y = 0;  // in the picture [pixels], from its upper left corner
  double depth = 0;     // along the view axis [m]
};
ViewPoint view_point(const render::Camera&, const render::Vec3& world);

/// What is nearer to the camera, or behind it, is not drawn [m].
inline constexpr double near_depth = 1e-4;

/// Triangles as a camera sees them, at 2x2 samples a pixel: which one is in front, and how far away. The
/// same for every back end and on every machine. [Weghorst, Hooper, Greenberg 1984: item buffer]
class ItemBuffer {
public:
  static constexpr int none = -1;
  static constexpr int samples = 2;  // along the side of a pixel

  explicit ItemBuffer(const render::Camera&);

  /// Draws triangles, the i-th as item first_item + i. Of equally distant ones the last drawn is seen.
  void draw(std::span<const render::Triangle>, std::span<const render::Vec3> positions, int first_item = 0);

  /// Takes away what is in front: from now on only what is behind it is drawn. [Everitt 2001]
  void peel();

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool holds(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  /// None where nothing is.
  int item(int column, int row) const { return items_[at(column, row)]; }
  /// +inf where nothing is. [m]
  double depth(int column, int row) const { return depths_[at(column, row)]; }

private:
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  void fill(const ViewPoint& a, const ViewPoint& b, const ViewPoint& c, int item);

  render::Camera camera_;
  int columns_, rows_;
  std::vector<float> depths_;
  std::vector<float> peeled_;  // depths of what was taken away; none at first
  std::vector<int> items_;
};

}  // namespace lagomorph::apps
