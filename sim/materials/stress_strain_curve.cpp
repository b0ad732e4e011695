#include "sim/materials/stress_strain_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/error.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

void check_data(const std::vector<std::array<double, 2>>& data, const std::string& where) {
  if (data.empty()) throw InputError(where + ": data has no points; give [[strain, stress], ...]");
  for (std::size_t i = 0; i < data.size(); ++i) {
    const auto [strain, stress] = data[i];
    const std::string at = where + ": data point " + std::to_string(i);
    if (!std::isfinite(strain) || !std::isfinite(stress)) throw InputError(at + " must be finite");
    if (!(strain > -1.0))
      throw InputError(at + ": strain = " + short_number(strain) + " must be > -1, a stretch > 0");
    if (strain == 0.0 && stress != 0.0)
      throw InputError(at + ": stress = " + short_number(stress) + " Pa at strain 0 must be 0");
  }
  if (data.size() == 1 && data[0][0] == 0.0)
    throw InputError(where + ": data has no point but the origin; give one with another strain");
}

}  // namespace

StressStrainCurve::StressStrainCurve(const std::vector<std::array<double, 2>>& data, double young,
                                     double poisson, const std::string& where)
    : poisson_(poisson) {
  check_data(data, where);
  for (const auto& [strain, stress] : data)
    knots_.push_back({std::log1p(strain), (1.0 + strain) * stress, 0.0});
  const auto by_x = [](const Knot& a, const Knot& b) { return a.x < b.x; };
  std::sort(knots_.begin(), knots_.end(), by_x);
  const auto at_rest = std::lower_bound(knots_.begin(), knots_.end(), Knot{0.0, 0.0, 0.0}, by_x);
  const auto origin = static_cast<std::size_t>(at_rest - knots_.begin());
  if (at_rest == knots_.end() || at_rest->x != 0.0) knots_.insert(at_rest, {0.0, 0.0, 0.0});
  for (std::size_t i = 1; i < knots_.size(); ++i) {
    const Knot &a = knots_[i - 1], &b = knots_[i];
    if (!(a.x < b.x))
      throw InputError(where + ": data has strain " + short_number(std::expm1(a.x)) +
                       " twice; give each its own");
    if (!(a.T < b.T))
      throw InputError(where + ": data: (1 + strain) stress falls from " + short_number(a.T) + " Pa to " +
                       short_number(b.T) + " Pa between the strains " + short_number(std::expm1(a.x)) +
                       " and " + short_number(std::expm1(b.x)) + "; it must grow");
  }
  set_slopes();
  if (young > 0.0) {
    const double scale = young / knots_[origin].slope;
    for (Knot& k : knots_) {
      k.T *= scale;
      k.slope *= scale;
    }
  }
  young_ = knots_[origin].slope;
  for (const Knot& k : knots_) steepest_ = std::max(steepest_, k.slope);
  // S from the origin outwards: ∫ of the cubic between two knots is h/2 (T_0 + T_1) + h²/12 (m_0 - m_1).
  const auto area = [](const Knot& a, const Knot& b) {
    const double h = b.x - a.x;
    return 0.5 * h * (a.T + b.T) + h * h / 12.0 * (a.slope - b.slope);
  };
  for (std::size_t i = origin + 1; i < knots_.size(); ++i)
    knots_[i].S = knots_[i - 1].S + area(knots_[i - 1], knots_[i]);
  for (std::size_t i = origin; i-- > 0;) knots_[i].S = knots_[i + 1].S - area(knots_[i], knots_[i + 1]);
  close_the_sum_at_rest(origin);
}

/// Within: the weighted harmonic mean of both secants, which keeps the cubics monotone. [Fritsch and Butland
/// 1984, "A Method for Constructing Local Monotone Piecewise Cubic Interpolants"] At the ends: the parabola
/// through three points, held within 1/3 and 3 of the secant.
void StressStrainCurve::set_slopes() {
  const std::size_t n = knots_.size();
  const auto h = [&](std::size_t i) { return knots_[i + 1].x - knots_[i].x; };
  const auto secant = [&](std::size_t i) { return (knots_[i + 1].T - knots_[i].T) / h(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double a = 2.0 * h(i) + h(i - 1), b = h(i) + 2.0 * h(i - 1);
    knots_[i].slope = (a + b) / (a / secant(i - 1) + b / secant(i));
  }
  const auto end_slope = [&](std::size_t i, std::size_t next) {
    const double slope =
        n > 2 ? ((2.0 * h(i) + h(next)) * secant(i) - h(i) * secant(next)) / (h(i) + h(next)) : secant(i);
    return std::clamp(slope, secant(i) / 3.0, 3.0 * secant(i));
  };
  knots_.front().slope = end_slope(0, 1);
  knots_.back().slope = end_slope(n - 2, n > 2 ? n - 3 : 0);
}

/// T is Σ_k a_k x^k on either side of 0, and (-nu)^n x changes sides: with the other side's b_k,
/// c_k = (a_k + (-nu)^k b_k) / (1 - nu^(2k)).
void StressStrainCurve::close_the_sum_at_rest(std::size_t origin) {
  const double m = knots_[origin].slope;
  std::array<std::array<double, 4>, 2> T = {};
  const auto cubic = [&](const Knot& end) {
    const double secant = end.T / end.x;
    return std::array<double, 4>{0.0, m, (3.0 * secant - 2.0 * m - end.slope) / end.x,
                                 (m + end.slope - 2.0 * secant) / (end.x * end.x)};
  };
  const bool has_low = origin > 0, has_high = origin + 1 < knots_.size();
  T[0] = has_low ? cubic(knots_[origin - 1]) : std::array<double, 4>{0.0, m, 0.0, 0.0};
  T[1] = has_high ? cubic(knots_[origin + 1]) : std::array<double, 4>{0.0, m, 0.0, 0.0};
  low_ = has_low ? knots_[origin - 1].x : -kEverywhere;
  high_ = has_high ? knots_[origin + 1].x : kEverywhere;
  for (std::size_t side = 0; side < 2; ++side) {
    double power = 1.0;  // (-nu)^k
    for (std::size_t k = 1; k < 4; ++k) {
      power *= -poisson_;
      closed_[side][k] = (T[side][k] + power * T[1 - side][k]) / (1.0 - power * power);
    }
  }
}

StressStrainCurve::Stress StressStrainCurve::stress(double x) const {
  const auto along = [&](const Knot& end) -> Stress {
    const double d = x - end.x;
    return {end.S + d * (end.T + 0.5 * d * end.slope), end.T + d * end.slope, end.slope};
  };
  if (!(x > knots_.front().x)) return along(knots_.front());
  if (x >= knots_.back().x) return along(knots_.back());
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), x,
                                      [](double value, const Knot& k) { return value < k.x; });
  const Knot &a = *(above - 1), &b = *above;
  const double h = b.x - a.x, d = x - a.x, secant = (b.T - a.T) / h;
  const double c2 = (3.0 * secant - 2.0 * a.slope - b.slope) / h;
  const double c3 = (a.slope + b.slope - 2.0 * secant) / (h * h);
  return {a.S + d * (a.T + d * (0.5 * a.slope + d * (c2 / 3.0 + 0.25 * d * c3))),
          a.T + d * (a.slope + d * (c2 + d * c3)), a.slope + d * (2.0 * c2 + 3.0 * d * c3)};
}

StressStrainCurve::Values StressStrainCurve::at(double x) const {
  Values sum;
  double power = 1.0;  // (-nu)^n
  while (!(x >= low_ && x <= high_ && -poisson_ * x >= low_ && -poisson_ * x <= high_)) {
    const Stress s = stress(x);
    sum.W += s.S / power;
    sum.G += s.T;
    sum.dG_dx += power * s.dT_dx;
    power *= -poisson_;
    x *= -poisson_;
    if (poisson_ == 0.0 || !std::isfinite(x)) return sum;
  }
  const std::array<double, 4>& c = closed_[x < 0.0 ? 0 : 1];
  sum.W += x * x * (c[1] / 2.0 + x * (c[2] / 3.0 + x * c[3] / 4.0)) / power;
  sum.G += x * (c[1] + x * (c[2] + x * c[3]));
  sum.dG_dx += power * (c[1] + x * (2.0 * c[2] + x * 3.0 * c[3]));
  return sum;
}

}  // namespace lagomorph::sim
