#include "sim/materials/stress_strain_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/error.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

using Knot = HermiteCurve::Knot;

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

/// Within: the weighted harmonic mean of both secants, which keeps the cubics monotone. [Fritsch and Butland
/// 1984, "A Method for Constructing Local Monotone Piecewise Cubic Interpolants"] At the ends: the parabola
/// through three points, held within 1/3 and 3 of the secant.
void set_slopes(std::vector<Knot>& knots) {
  const std::size_t n = knots.size();
  const auto h = [&](std::size_t i) { return knots[i + 1].x - knots[i].x; };
  const auto secant = [&](std::size_t i) { return (knots[i + 1].y - knots[i].y) / h(i); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double a = 2.0 * h(i) + h(i - 1), b = h(i) + 2.0 * h(i - 1);
    knots[i].slope = (a + b) / (a / secant(i - 1) + b / secant(i));
  }
  const auto end_slope = [&](std::size_t i, std::size_t next) {
    const double slope =
        n > 2 ? ((2.0 * h(i) + h(next)) * secant(i) - h(i) * secant(next)) / (h(i) + h(next)) : secant(i);
    return std::clamp(slope, secant(i) / 3.0, 3.0 * secant(i));
  };
  knots.front().slope = end_slope(0, 1);
  knots.back().slope = end_slope(n - 2, n > 2 ? n - 3 : 0);
}

/// The data by growing x = log λ, with the origin.
std::vector<Knot> knots_of(const std::vector<std::array<double, 2>>& data, const std::string& where) {
  std::vector<Knot> knots;
  knots.reserve(data.size() + 1);
  for (const auto& [strain, stress] : data)
    knots.push_back({std::log1p(strain), (1.0 + strain) * stress, 0.0});
  if (std::none_of(knots.begin(), knots.end(), [](const Knot& k) { return k.x == 0.0; }))
    knots.push_back({0.0, 0.0, 0.0});
  std::sort(knots.begin(), knots.end(), [](const Knot& a, const Knot& b) { return a.x < b.x; });
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Knot &a = knots[i - 1], &b = knots[i];
    if (!(a.x < b.x))
      throw InputError(where + ": data has strain " + short_number(std::expm1(a.x)) +
                       " twice; give each its own");
    if (!(a.y < b.y))
      throw InputError(where + ": data: (1 + strain) stress falls from " + short_number(a.y) + " Pa to " +
                       short_number(b.y) + " Pa between the strains " + short_number(std::expm1(a.x)) +
                       " and " + short_number(std::expm1(b.x)) + "; it must grow");
  }
  return knots;
}

/// Where G is found: the data, as many places again between them and beyond, where T is straight and G is
/// nearly.
std::vector<Knot> grid_around(const std::vector<Knot>& data) {
  constexpr int within = 96, beyond = 48;
  const double range = std::max(-data.front().x, data.back().x);
  std::vector<double> places;
  places.reserve(data.size() + 2 * (within + beyond));
  for (const Knot& k : data) places.push_back(k.x);
  for (const double side : {-1.0, 1.0}) {
    for (int i = 1; i <= within; ++i) places.push_back(side * range * i / within);
    for (int i = 1; i <= beyond; ++i) places.push_back(side * range * (1.0 + 3.0 * i / beyond));
  }
  std::sort(places.begin(), places.end());
  std::vector<Knot> grid;
  for (const double x : places) {
    if (grid.empty() || x - grid.back().x > 1e-9 * range) grid.push_back({x, 0.0, 0.0});
  }
  // The data themselves stay, not what lies beside them.
  for (const Knot& k : data) {
    const auto nearest = std::min_element(grid.begin(), grid.end(), [&](const Knot& a, const Knot& b) {
      return std::abs(a.x - k.x) < std::abs(b.x - k.x);
    });
    nearest->x = k.x;
  }
  return grid;
}

}  // namespace

StressStrainCurve::StressStrainCurve(const std::vector<std::array<double, 2>>& data, double young,
                                     double poisson, const std::string& where)
    : poisson_(poisson) {
  check_data(data, where);
  std::vector<Knot> knots = knots_of(data, where);
  set_slopes(knots);
  const double at_rest =
      std::find_if(knots.begin(), knots.end(), [](const Knot& k) { return k.x == 0.0; })->slope;
  if (young > 0.0) {
    for (Knot& k : knots) {
      k.y *= young / at_rest;
      k.slope *= young / at_rest;
    }
  }
  young_ = young > 0.0 ? young : at_rest;
  lambda_ = young_ * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  for (const Knot& k : knots) steepest_ = std::max(steepest_, k.slope);
  density_ = HermiteCurve(grid_around(knots));
  stress_ = HermiteCurve(std::move(knots));
  find_density();
}

double StressStrainCurve::lateral(double x) const {
  if (lambda_ == 0.0) return 0.0;
  // G' > -lambda, as T' > 0: what is to vanish grows with y.
  double low = -std::abs(x), high = std::abs(x), y = -poisson_ * x;
  for (int i = 0; i < 100; ++i) {
    const HermiteCurve::Values g = density_.at(y);
    const double left = lambda_ * (x + 2.0 * y) + g.y;
    (left > 0.0 ? high : low) = y;
    double next = y - left / (2.0 * lambda_ + g.slope);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - y) <= 1e-16 * std::abs(x)) return next;
    y = next;
  }
  return y;
}

/// From the origin outwards, again until nothing changes: a knot near the origin leans on itself.
void StressStrainCurve::find_density() {
  const std::vector<Knot>& knots = density_.knots();
  for (std::size_t i = 0; i < knots.size(); ++i)
    density_.set(i, young_ / (1.0 + poisson_) * knots[i].x, young_ / (1.0 + poisson_));
  std::vector<std::size_t> outwards(knots.size());
  std::iota(outwards.begin(), outwards.end(), 0);
  std::stable_sort(outwards.begin(), outwards.end(),
                   [&](std::size_t a, std::size_t b) { return std::abs(knots[a].x) < std::abs(knots[b].x); });
  const double largest = std::max(-stress_.at(knots.front().x).y, stress_.at(knots.back().x).y);
  for (int sweep = 0; sweep < 200; ++sweep) {
    double change = 0.0;
    for (const std::size_t i : outwards) {
      const double x = knots[i].x;
      if (x == 0.0) continue;
      const HermiteCurve::Values T = stress_.at(x);
      const HermiteCurve::Values side = density_.at(lateral(x));
      const double slope =
          lambda_ == 0.0 ? T.slope : T.slope - lambda_ * side.slope / (2.0 * lambda_ + side.slope);
      change = std::max(change, std::abs(T.y + side.y - knots[i].y));
      density_.set(i, T.y + side.y, slope);
    }
    if (change <= 1e-15 * largest) break;
  }
  density_.integrate();
}

}  // namespace lagomorph::sim
