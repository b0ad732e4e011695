#include "apps/material/closed_forms.h"

#include <cmath>
#include <string>
#include <vector>

#include "sim/error.h"
#include "sim/materials/mooney_rivlin.h"
#include "sim/materials/neo_hookean.h"
#include "sim/materials/parameters.h"
#include "sim/materials/stress_strain.h"

namespace lagomorph::apps {
namespace {

using sim::Lame;
using sim::Vec3;

/// dψ/ds with ψ = c(J): c'(J) J/s.
Vec3 volumetric(double slope, const Vec3& s) { return slope * s.prod() * s.cwiseInverse(); }

/// Of the sum of stretches at simple shear: √(4 + amount²), and the derivative by the amount.
double pair_sum(double amount) { return std::sqrt(4.0 + amount * amount); }

ClosedForm neo_hookean(const sim::MaterialSettings& settings) {
  const auto m = sim::NeoHookean::from_settings(settings, settings.model);
  return {[m](const Vec3& s) -> Vec3 {
            const double J = s.prod(), I = s.squaredNorm();
            return 2.0 * m.C * std::pow(J, -2.0 / 3.0) * (s - I / 3.0 * s.cwiseInverse()) +
                   volumetric(2.0 * m.D * (J - 1.0), s);
          },
          [m](double amount) { return 2.0 * m.C * amount; }};
}

ClosedForm mooney_rivlin(const sim::MaterialSettings& settings) {
  const auto m = sim::MooneyRivlin::from_settings(settings, settings.model);
  return {[m](const Vec3& s) -> Vec3 {
            const double J = s.prod(), I_1 = s.squaredNorm(), I_2 = J * J * s.cwiseInverse().squaredNorm();
            const Vec3 dI_2 = 2.0 * (I_1 * s.array() - s.array().cube());
            return m.C10 * std::pow(J, -2.0 / 3.0) * (2.0 * s - 2.0 / 3.0 * I_1 * s.cwiseInverse()) +
                   m.C01 * std::pow(J, -4.0 / 3.0) * (dI_2 - 4.0 / 3.0 * I_2 * s.cwiseInverse()) +
                   volumetric(m.bulk * (J - 1.0), s);
          },
          [m](double amount) { return 2.0 * (m.C10 + m.C01) * amount; }};
}

ClosedForm neo_hookean_log(const Lame& m) {
  return {[m](const Vec3& s) -> Vec3 {
            return m.mu * s + (m.lambda * std::log(s.prod()) - m.mu) * s.cwiseInverse();
          },
          [m](double amount) { return m.mu * amount; }};
}

ClosedForm stable_neo_hookean(const Lame& m) {
  return {[m](const Vec3& s) -> Vec3 {
            return m.mu * s + volumetric((m.lambda + m.mu) * (s.prod() - 1.0) - m.mu, s);
          },
          [m](double amount) { return m.mu * amount; }};
}

ClosedForm stable_neo_hookean_log(const Lame& lame) {
  const double m = 4.0 / 3.0 * lame.mu, l = lame.lambda + 5.0 / 6.0 * lame.mu;
  return {[m, l](const Vec3& s) -> Vec3 {
            return m * (1.0 - 1.0 / (s.squaredNorm() + 1.0)) * s +
                   volumetric(l * (s.prod() - 1.0) - 0.75 * m, s);
          },
          [m](double amount) { return m * amount * (1.0 - 1.0 / (4.0 + amount * amount)); }};
}

ClosedForm st_venant_kirchhoff(const Lame& m) {
  return {[m](const Vec3& s) -> Vec3 {
            const Eigen::Array3d strain = 0.5 * (s.array().square() - 1.0);
            return s.array() * (2.0 * m.mu * strain + m.lambda * strain.sum());
          },
          [m](double amount) { return m.mu * amount + (m.mu + 0.5 * m.lambda) * amount * amount * amount; }};
}

ClosedForm corotated(const Lame& m) {
  return {[m](const Vec3& s) -> Vec3 {
            const Eigen::Array3d strain = s.array() - 1.0;
            return 2.0 * m.mu * strain + m.lambda * strain.sum();
          },
          [m](double amount) {
            const double t = pair_sum(amount);
            return 2.0 * m.mu * amount + (m.lambda * (t - 2.0) - 2.0 * m.mu) * amount / t;
          }};
}

ClosedForm fixed_corotated(const Lame& m) {
  return {[m](const Vec3& s) -> Vec3 {
            return 2.0 * m.mu * (s - Vec3::Ones()) + volumetric(m.lambda * (s.prod() - 1.0), s);
          },
          [m](double amount) { return 2.0 * m.mu * amount * (1.0 - 1.0 / pair_sum(amount)); }};
}

ClosedForm arap(const Lame& m) { return corotated({.mu = m.mu, .lambda = 0.0}); }

ClosedForm linear(const Lame& m) {
  return {corotated(m).principal, [m](double amount) { return m.mu * amount; }};
}

/// G from the uniaxial data alone, without the material's table: where an axis at x has free sides at y,
/// lambda (x + 2y) + G(y) = 0 and G(x) = T(x) + G(y), so that from a y near 0, where G = 2 mu y, each x that
/// leans on the one before follows in turn; the first y is the one whose last x is that asked for.
double chained(const sim::StressStrainCurve& curve, double x) {
  const double nu = curve.poisson();
  if (x == 0.0 || nu == 0.0) return curve.stress(x).y;
  const int links = static_cast<int>(std::ceil(std::log(1e-12) / std::log(nu)));
  const double sign = links % 2 == 0 ? x : -x;
  double low = std::log(1e-40), high = 0.0, G = 0.0;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    double at = sign * std::exp(middle);
    G = curve.young() / (1.0 + nu) * at;
    for (int k = 0; k < links; ++k) {
      at = -2.0 * at - G / curve.lambda();
      G += curve.stress(at).y;
    }
    if (middle == low || middle == high) break;
    (at / x > 1.0 ? high : low) = middle;
  }
  return G;
}

/// P_i s_i = G(log s_i) + lambda log J.
ClosedForm stress_strain(const sim::MaterialSettings& settings) {
  const auto curve = sim::StressStrain::from_settings(settings, settings.model).curve;
  return {[curve](const Vec3& s) -> Vec3 {
            const double k = curve->lambda() * std::log(s.prod());
            return s.unaryExpr([&](double t) { return (chained(*curve, std::log(t)) + k) / t; });
          },
          [curve](double amount) {
            const double x = std::asinh(0.5 * amount);  // stretches e^x, e^-x, 1
            return (chained(*curve, x) - chained(*curve, -x)) / pair_sum(amount);
          }};
}

struct Row {
  std::string model;
  ClosedForm (*make)(const Lame&);
};

}  // namespace

ClosedForm closed_form(const sim::MaterialSettings& settings) {
  if (settings.model == sim::NeoHookean::kName) return neo_hookean(settings);
  if (settings.model == sim::MooneyRivlin::kName) return mooney_rivlin(settings);
  if (settings.model == sim::StressStrain::kName) return stress_strain(settings);
  static const std::vector<Row> rows = {
      {"neo_hookean_log", neo_hookean_log},
      {"stable_neo_hookean", stable_neo_hookean},
      {"stable_neo_hookean_log", stable_neo_hookean_log},
      {"st_venant_kirchhoff", st_venant_kirchhoff},
      {"corotated", corotated},
      {"fixed_corotated", fixed_corotated},
      {"arap", arap},
      {"linear", linear},
  };
  for (const Row& row : rows)
    if (row.model == settings.model) return row.make(sim::lame_parameters(settings, settings.model));
  throw sim::InputError("no closed form for material model '" + settings.model + "'");
}

}  // namespace lagomorph::apps
