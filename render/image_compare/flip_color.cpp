#include "render/image_compare/flip_color.h"

#include <cmath>

namespace lagomorph::render::flip {
namespace {

constexpr double delta = 6.0 / 29.0;

/// f of CIE L*a*b* [CIE 15].
double lab_curve(double t) {
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29.0;
}

/// From the primaries of Rec. 709 and the white D65, (0.3127, 0.3290); rational, as FLIP's authors use it.
constexpr Matrix xyz_from_rgb{{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                               {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                               {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};

Matrix relative(Matrix m) {
  for (Triple& row : m) {
    const double white = row[0] + row[1] + row[2];
    for (double& entry : row) entry /= white;
  }
  return m;
}

Matrix inverse(const Matrix& m) {
  const auto cofactor = [&](std::size_t r, std::size_t c) {
    const std::size_t r1 = (r + 1) % 3;
    const std::size_t r2 = (r + 2) % 3;
    const std::size_t c1 = (c + 1) % 3;
    const std::size_t c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix result{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) result[r][c] = cofactor(c, r) / determinant;
  }
  return result;
}

}  // namespace

const Matrix& relative_xyz_from_rgb() {
  static const Matrix matrix = relative(xyz_from_rgb);
  return matrix;
}

const Matrix& rgb_from_relative_xyz() {
  static const Matrix matrix = inverse(relative_xyz_from_rgb());
  return matrix;
}

Triple product(const Matrix& m, const Triple& v) {
  Triple result{};
  for (std::size_t r = 0; r < 3; ++r) result[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return result;
}

Triple hunt_lab(const Triple& xyz) {
  const double x = lab_curve(xyz[0]);
  const double y = lab_curve(xyz[1]);
  const double z = lab_curve(xyz[2]);
  const double l = 116 * y - 16;
  return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}

double hyab(const Triple& p, const Triple& q) {
  return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]);
}

double largest_color_distance() {
  static const double largest = std::pow(hyab(hunt_lab(product(relative_xyz_from_rgb(), {0, 1, 0})),
                                              hunt_lab(product(relative_xyz_from_rgb(), {0, 0, 1}))),
                                         color_exponent);
  return largest;
}

double color_difference(const Triple& p, const Triple& q) {
  const double largest = largest_color_distance();
  const double distance = std::pow(hyab(p, q), color_exponent);
  const double knee = knee_in * largest;
  if (distance < knee) return distance * knee_out / knee;
  return knee_out + (distance - knee) / (largest - knee) * (1 - knee_out);
}

}  // namespace lagomorph::render::flip
