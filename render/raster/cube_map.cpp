#include "render/raster/cube_map.h"

#include <cmath>

namespace lagomorph::render::raster {

Vec3 cube_point(int face, float s, float t) {
  switch (face) {
    case 0:
      return {1.0F, -t, -s};
    case 1:
      return {-1.0F, -t, s};
    case 2:
      return {s, 1.0F, t};
    case 3:
      return {s, -1.0F, -t};
    case 4:
      return {s, -t, 1.0F};
    default:
      return {-s, -t, -1.0F};
  }
}

Vec3 cube_texel_point(int size, int face, int x, int y) {
  const auto center = [size](int i) {
    return (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(size) - 1.0F;
  };
  return cube_point(face, center(x), center(y));
}

CubePlace cube_place(const Vec3& d) {
  const Vec3 a = d.cwiseAbs();
  if (a.x() >= a.y() && a.x() >= a.z()) {
    return d.x() > 0.0F ? CubePlace{0, -d.z() / a.x(), -d.y() / a.x()}
                        : CubePlace{1, d.z() / a.x(), -d.y() / a.x()};
  }
  if (a.y() >= a.z()) {
    return d.y() > 0.0F ? CubePlace{2, d.x() / a.y(), d.z() / a.y()}
                        : CubePlace{3, d.x() / a.y(), -d.z() / a.y()};
  }
  return d.z() > 0.0F ? CubePlace{4, d.x() / a.z(), -d.y() / a.z()}
                      : CubePlace{5, -d.x() / a.z(), -d.y() / a.z()};
}

double cube_texel_solid_angle(int size, int x, int y) {
  // Of the rectangle from the face's middle to (s, t): atan(s t / sqrt(1 + s^2 + t^2)).
  const auto corner = [size](int i, int j) {
    const double s = 2.0 * i / size - 1.0, t = 2.0 * j / size - 1.0;
    return std::atan(s * t / std::sqrt(1.0 + s * s + t * t));
  };
  return corner(x + 1, y + 1) - corner(x, y + 1) - corner(x + 1, y) + corner(x, y);
}

}  // namespace lagomorph::render::raster
