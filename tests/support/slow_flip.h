#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "render/image_compare/flip_color.h"
#include "render/pixels.h"
#include "tests/support/pictures.h"

namespace lagomorph::render::tests {

/// FLIP as the paper has it: two-dimensional filters, pixel by pixel, in double.
class SlowFlip {
public:
  SlowFlip(const render::Pixels& a, const render::Pixels& b, double ppd)
      : SlowFlip(a.width, a.height, linear(a), linear(b), ppd) {}
  /// Of linear light in [0, 1], 3 values a pixel.
  SlowFlip(int width, int height, const std::vector<double>& a, const std::vector<double>& b, double ppd)
      : width_(width), height_(height), ppd_(ppd), opponent_{opponent(a), opponent(b)} {
    spatial_radius_ = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    for (std::size_t c = 0; c < 3; ++c) spatial_[c] = spatial_filter(c);
    const double sigma = 0.5 * 0.082 * ppd;
    feature_radius_ = static_cast<int>(std::ceil(3 * sigma));
    edge_ = feature_filter(sigma, [](double x, double) { return -x; });
    point_ = feature_filter(sigma, [](double x, double s) { return x * x / (s * s) - 1; });
  }

  double at(int x, int y) const {
    const double color = render::flip::color_difference(lab(0, x, y), lab(1, x, y));
    const double edge = std::abs(length(edge_, 0, x, y) - length(edge_, 1, x, y));
    const double point = std::abs(length(point_, 0, x, y) - length(point_, 1, x, y));
    const double feature = std::sqrt(std::max(edge, point) / std::sqrt(2.0));
    return std::pow(color, 1 - feature);
  }

private:
  static constexpr double pi = std::numbers::pi;
  using Triple = render::flip::Triple;
  using Filter = std::vector<double>;  // rows of (2 r + 1)

  static std::vector<double> linear(const render::Pixels& pixels) {
    std::vector<double> result;
    for (const std::uint8_t byte : bytes_of(pixels)) {
      const double s = byte / 255.0;
      result.push_back(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return result;
  }

  /// XYZ / white to Y, X - Y, Y - Z.
  static std::vector<Triple> opponent(const std::vector<double>& rgb) {
    std::vector<Triple> result;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
      const Triple xyz =
          render::flip::product(render::flip::relative_xyz_from_rgb(), {rgb[i], rgb[i + 1], rgb[i + 2]});
      result.push_back({xyz[1], xyz[0] - xyz[1], xyz[1] - xyz[2]});
    }
    return result;
  }

  Filter spatial_filter(std::size_t channel) const {
    constexpr double a1[] = {1, 1, 34.1};
    constexpr double b1[] = {0.0047, 0.0053, 0.04};
    constexpr double a2[] = {0, 0, 13.5};
    constexpr double b2[] = {1e-5, 1e-5, 0.025};
    Filter filter;
    double sum = 0;
    for (int y = -spatial_radius_; y <= spatial_radius_; ++y) {
      for (int x = -spatial_radius_; x <= spatial_radius_; ++x) {
        const double r2 = (x * x + y * y) / (ppd_ * ppd_);
        const auto term = [&](double a, double b) {
          return a * std::sqrt(pi / b) * std::exp(-pi * pi * r2 / b);
        };
        filter.push_back(term(a1[channel], b1[channel]) + term(a2[channel], b2[channel]));
        sum += filter.back();
      }
    }
    for (double& w : filter) w /= sum;
    return filter;
  }

  template <class Derivative>
  Filter feature_filter(double sigma, const Derivative& derivative) const {
    Filter filter;
    double positive = 0;
    double negative = 0;
    for (int y = -feature_radius_; y <= feature_radius_; ++y) {
      for (int x = -feature_radius_; x <= feature_radius_; ++x) {
        filter.push_back(derivative(x, sigma) * std::exp(-(x * x + y * y) / (2 * sigma * sigma)));
        (filter.back() > 0 ? positive : negative) += std::abs(filter.back());
      }
    }
    for (double& w : filter) w /= w > 0 ? positive : negative;
    return filter;
  }

  double filtered(const Filter& filter, int radius, bool transposed, std::size_t which, std::size_t channel,
                  int x, int y) const {
    double sum = 0;
    const int size = 2 * radius + 1;
    for (int j = -radius; j <= radius; ++j) {
      for (int i = -radius; i <= radius; ++i) {
        const int at = std::clamp(y + j, 0, height_ - 1) * width_ + std::clamp(x + i, 0, width_ - 1);
        const int w = transposed ? (i + radius) * size + j + radius : (j + radius) * size + i + radius;
        sum += filter[static_cast<std::size_t>(w)] * opponent_[which][static_cast<std::size_t>(at)][channel];
      }
    }
    return sum;
  }

  Triple lab(std::size_t which, int x, int y) const {
    Triple v{};
    for (std::size_t c = 0; c < 3; ++c) v[c] = filtered(spatial_[c], spatial_radius_, false, which, c, x, y);
    Triple rgb =
        render::flip::product(render::flip::rgb_from_relative_xyz(), {v[0] + v[1], v[0], v[0] - v[2]});
    for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
    return render::flip::hunt_lab(render::flip::product(render::flip::relative_xyz_from_rgb(), rgb));
  }

  double length(const Filter& filter, std::size_t which, int x, int y) const {
    return std::hypot(filtered(filter, feature_radius_, false, which, 0, x, y),
                      filtered(filter, feature_radius_, true, which, 0, x, y));
  }

  int width_;
  int height_;
  double ppd_;
  std::array<std::vector<Triple>, 2> opponent_;
  int spatial_radius_ = 0;
  int feature_radius_ = 0;
  std::array<Filter, 3> spatial_;
  Filter edge_;
  Filter point_;
};

}  // namespace lagomorph::render::tests
