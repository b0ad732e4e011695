#include "render/image_compare/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "render/error.h"

namespace lagomorph::render {
namespace {

using std::numbers::pi;

/// a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees [Andersson 2020, Eq. 5 and Table 1].
struct Sensitivity {
  double a;
  double b;
};
constexpr Sensitivity achromatic{1.0, 0.0047};
constexpr Sensitivity red_green{1.0, 0.0053};
constexpr Sensitivity blue_yellow_1{34.1, 0.04};
constexpr Sensitivity blue_yellow_2{13.5, 0.025};
constexpr double widest = blue_yellow_1.b;

constexpr double feature_width = 0.082;  // degrees

/// exp(-pi^2 x^2 / b) at the offsets 0..radius.
std::vector<double> bell(double b, double pixels_per_degree, int radius) {
  std::vector<double> weights;
  for (int k = 0; k <= radius; ++k) {
    const double x = k / pixels_per_degree;
    weights.push_back(std::exp(-pi * pi * x * x / b));
  }
  return weights;
}

double even_sum(const std::vector<double>& half) {
  double sum = -half[0];
  for (const double w : half) sum += 2 * w;
  return sum;
}

EvenFilter scaled(const std::vector<double>& half, double factor) {
  EvenFilter filter;
  for (const double w : half) filter.push_back(static_cast<float>(factor * w));
  return filter;
}

/// Weights that sum to 1, without tails that a float sum cannot see.
EvenFilter normalized(std::vector<double> half) {
  const double total = even_sum(half);
  while (half.size() > 1 && half.back() < 1e-8 * half[0]) half.pop_back();
  return scaled(half, 1 / total);
}

void set_sensitivity(FlipFilters& filters, double pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree));
  filters.y = normalized(bell(achromatic.b, pixels_per_degree, radius));
  filters.cx = normalized(bell(red_green.b, pixels_per_degree, radius));
  // The sum of the two Gaussians sums to 1 in two dimensions; each is its own square root's product.
  const std::vector<double> bell_1 = bell(blue_yellow_1.b, pixels_per_degree, radius);
  const std::vector<double> bell_2 = bell(blue_yellow_2.b, pixels_per_degree, radius);
  const double height_1 = blue_yellow_1.a * std::sqrt(pi / blue_yellow_1.b);
  const double height_2 = blue_yellow_2.a * std::sqrt(pi / blue_yellow_2.b);
  const double total = height_1 * std::pow(even_sum(bell_1), 2) + height_2 * std::pow(even_sum(bell_2), 2);
  filters.cz_1 = scaled(bell_1, std::sqrt(height_1 / total));
  filters.cz_2 = scaled(bell_2, std::sqrt(height_2 / total));
}

void set_features(FlipFilters& filters, double pixels_per_degree) {
  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<double> gauss;
  std::vector<double> first;
  std::vector<double> second;
  double first_sum = 0;
  double second_positive = 0;
  double second_negative = 0;
  for (int k = 0; k <= radius; ++k) {
    gauss.push_back(std::exp(-k * k / (2 * sigma * sigma)));
    first.push_back(k * gauss.back());
    second.push_back((k * k / (sigma * sigma) - 1) * gauss.back());
    first_sum += first.back();
    (second.back() > 0 ? second_positive : second_negative) += (k == 0 ? 1 : 2) * std::abs(second.back());
  }
  filters.gauss = scaled(gauss, 1 / even_sum(gauss));
  filters.first = scaled(first, 1 / first_sum);
  for (double& w : second) w /= w > 0 ? second_positive : second_negative;
  filters.second = scaled(second, 1);
}

}  // namespace

std::size_t FlipFilters::halo() const { return std::max(cz_1.size(), gauss.size()) - 1; }

void check_pixels_per_degree(double value) {
  if (value >= least_pixels_per_degree && value <= most_pixels_per_degree) return;
  throw SettingsError("pixels per degree = " + std::to_string(value) + " must be in 1..1000");
}

FlipFilters flip_filters(double pixels_per_degree) {
  check_pixels_per_degree(pixels_per_degree);
  FlipFilters filters;
  set_sensitivity(filters, pixels_per_degree);
  set_features(filters, pixels_per_degree);
  return filters;
}

}  // namespace lagomorph::render
