#pragma once

#include <cstddef>
#include <vector>

#include "render/types.h"

namespace lagomorph::render::raster {

/// Six square pictures of what lies around a point, in OpenGL's order (+x, -x, +y, -y, +z, -z) and with its
/// axes. Rows and columns are counted from s = t = 0.
template <class Texel>
class CubeMap {
public:
  explicit CubeMap(int size)
      : size_(size), texels_(6 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

  int size() const { return size_; }
  const std::vector<Texel>& texels() const { return texels_; }
  Texel& at(int face, int x, int y) { return texels_[index(face, x, y)]; }
  const Texel& at(int face, int x, int y) const { return texels_[index(face, x, y)]; }

private:
  std::size_t index(int face, int x, int y) const {
    const auto n = static_cast<std::size_t>(size_);
    return (static_cast<std::size_t>(face) * n + static_cast<std::size_t>(y)) * n +
           static_cast<std::size_t>(x);
  }

  int size_;
  std::vector<Texel> texels_;
};

/// Point of a face, both coordinates in [-1, 1] (beyond: of the plane that the face lies in), as a vector
/// from the cube's middle: not of unit length.
Vec3 cube_point(int face, float s, float t);
/// The middle of a texel of a face with size x size of them, likewise; x and y may lie beyond the face.
Vec3 cube_texel_point(int size, int face, int x, int y);
/// And back: the face that a direction meets, and where.
struct CubePlace {
  int face;
  float s, t;
};
CubePlace cube_place(const Vec3& direction);
/// Solid angle of a texel of a face with size x size of them [sr].
double cube_texel_solid_angle(int size, int x, int y);

}  // namespace lagomorph::render::raster
