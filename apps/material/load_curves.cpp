#include "apps/material/load_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lagomorph::apps {
namespace {

using sim::Mat3;
using sim::Mat9;
using sim::Vec3;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// F = diag(stretches) of a load with free sides; `first_free` and what follows it is free.
Mat3 stretched(double stretch, double free, int first_free) {
  Vec3 s = Vec3::Constant(free);
  s.head(first_free).setConstant(stretch);
  return s.asDiagonal();
}

/// The free stretch at which the last principal stress vanishes, by Newton's method from `guess`: of τ = λ P
/// over ln λ, which turns back later than P over λ does.
std::optional<double> free_stretch(const sim::MaterialPoint& material, double stretch, double guess,
                                   int first_free) {
  constexpr double most = 0.5;  // of a change of ln λ
  double free = guess;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Mat3 F = stretched(stretch, free, first_free);
    const Mat9 H = material.d2psi_dF2(F);
    double slope = 0.0;  // dP_33/d free, over the diagonal entries 0, 4, 8 of vec(F)
    for (int k = first_free; k < 3; ++k) slope += H(8, 4 * k);
    const double P = material.dpsi_dF(F)(2, 2), tau_slope = P + free * slope;
    if (!(tau_slope > 0.0)) return std::nullopt;  // not a stable one
    const double step = std::clamp(-P / tau_slope, -most, most);
    free *= std::exp(step);
    if (std::abs(step) <= 1e-11) return free;  // it squares the error
  }
  return std::nullopt;
}

LoadPoint with_free_sides(const sim::MaterialPoint& material, const ClosedForm& closed, double stretch,
                          double& guess, int first_free) {
  const std::optional<double> free = free_stretch(material, stretch, guess, first_free);
  if (!free) return {stretch, unknown, unknown, unknown};
  guess = *free;
  const Mat3 F = stretched(stretch, *free, first_free);
  return {stretch, *free, material.dpsi_dF(F)(0, 0), closed.principal(F.diagonal())[0]};
}

/// Stretches of 0.6 to 2, from rest to both ends.
std::vector<LoadPoint> points_with_free_sides(const sim::MaterialPoint& material, const ClosedForm& closed,
                                              int first_free) {
  constexpr int below = 8, above = 20, parts = 10;  // steps of 0.05, each in parts
  std::vector<LoadPoint> points(below + 1 + above);
  for (const int direction : {-1, 1}) {
    double guess = 1.0;
    for (int i = 0; i <= (direction < 0 ? below : above); ++i) {
      const int place = below + direction * i;
      // In small steps, since a root may have a fold beside it.
      for (int k = i == 0 ? parts : 1; k <= parts; ++k) {
        const double steps = i == 0 ? 0.0 : i - 1 + static_cast<double>(k) / parts;
        points[static_cast<std::size_t>(place)] =
            with_free_sides(material, closed, 1.0 + 0.05 * direction * steps, guess, first_free);
      }
    }
  }
  return points;
}

}  // namespace

std::vector<LoadCurve> load_curves(const sim::MaterialPoint& material, const ClosedForm& closed) {
  std::vector<LoadCurve> curves = {
      {"uniaxial", "stretch", "P_11", true, points_with_free_sides(material, closed, 1)},
      {"biaxial", "stretch", "P_11 = P_22", true, points_with_free_sides(material, closed, 2)},
      {"shear", "amount", "P_12", false, {}},
      {"volumetric", "stretch", "P_11 = P_22 = P_33", false, {}}};
  for (int i = 0; i <= 30; ++i) {
    Mat3 F = Mat3::Identity();
    F(0, 1) = 0.05 * i;
    curves[2].points.push_back({F(0, 1), 1.0, material.dpsi_dF(F)(0, 1), closed.shear(F(0, 1))});
  }
  for (int i = -6; i <= 8; ++i) {
    const double s = 1.0 + 0.05 * i;
    const Vec3 all = Vec3::Constant(s);
    curves[3].points.push_back({s, 1.0, material.dpsi_dF(all.asDiagonal())(0, 0), closed.principal(all)[0]});
  }
  return curves;
}

}  // namespace lagomorph::apps
