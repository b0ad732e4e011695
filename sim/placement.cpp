#include "sim/placement.h"

#include <cmath>
#include <numbers>

namespace lagomorph::sim {

namespace {

double sin_degrees(double degrees) {
  const double turned = std::remainder(degrees, 360.0);  // exact, in [-180, 180]
  if (std::abs(turned) == 180.0) return 0.0;
  return std::sin(turned * (std::numbers::pi / 180.0));
}

double cos_degrees(double degrees) {
  const double turned = std::abs(std::remainder(degrees, 360.0));
  if (turned == 90.0) return 0.0;
  return std::cos(turned * (std::numbers::pi / 180.0));
}

}  // namespace

Mat3 rotation_of(const Vec3& degrees) {
  const Vec3 c = degrees.unaryExpr(&cos_degrees), s = degrees.unaryExpr(&sin_degrees);
  Mat3 Rx, Ry, Rz;
  Rx << 1, 0, 0, 0, c.x(), -s.x(), 0, s.x(), c.x();
  Ry << c.y(), 0, s.y(), 0, 1, 0, -s.y(), 0, c.y();
  Rz << c.z(), -s.z(), 0, s.z(), c.z(), 0, 0, 0, 1;
  return Rz * Ry * Rx;
}

void place(Points& X, const BodySettings& body) {
  const Mat3 R = rotation_of(body.rotate);
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    const Vec3 x = X.row(v);
    X.row(v) = (body.translate + R * (body.scale * x)).transpose();
  }
}

}  // namespace lagomorph::sim
