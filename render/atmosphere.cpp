#include "render/atmosphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace lagomorph::render {
namespace {

using Array = Eigen::Array3d;
using Vec = Eigen::Vector3d;

using std::numbers::pi;
constexpr double earth = 6.36e6;    // radius [m]
constexpr double top = 6.42e6;      // of the air
constexpr double air_height = 8e3;  // in which its density falls to 1/e [m]
constexpr double haze_height = 1.2e3;
constexpr double haze_forward = 0.76;             // g of its phase function
const Array air(5.8e-6, 13.5e-6, 33.1e-6);        // scattering at the ground [1/m]
const Array ozone(0.650e-6, 1.881e-6, 0.085e-6);  // absorption in its layer [1/m]
constexpr double ground_albedo = 0.3;

/// Of haze at the ground: none at turbidity 1, some 4e-6 at 2 [1/m].
double haze(double turbidity) { return 4e-6 * (turbidity - 1.0); }

/// Distance to a sphere around the origin from inside it.
double exit_distance(const Vec& x, const Vec& d, double radius) {
  const double b = x.dot(d);
  return -b + std::sqrt(std::max(b * b - x.squaredNorm() + radius * radius, 0.0));
}

/// To a sphere from outside of it, along a direction that meets it.
double entry_distance(const Vec& x, const Vec& d, double radius) {
  const double b = x.dot(d);
  return std::max(-b - std::sqrt(std::max(b * b - x.squaredNorm() + radius * radius, 0.0)), 0.0);
}

bool meets_earth(const Vec& x, const Vec& d) {
  const double b = x.dot(d);
  return b < 0.0 && b * b - x.squaredNorm() + earth * earth > 0.0;
}

/// Optical depth for one metre of air, haze and ozone at the ground's density.
struct Column {
  double air = 0.0, haze = 0.0, ozone = 0.0;  // [m]
  void add(double height, double length) {
    air += length * std::exp(-height / air_height);
    haze += length * std::exp(-height / haze_height);
    ozone += length * std::max(0.0, 1.0 - std::abs(height - 25e3) / 15e3);
  }
};

/// Calls with the middle and the length of the steps along a way, which grow as squares: the air is dense
/// near the ground.
void march(double length, int steps, const auto& visit) {
  const auto end = [&](int i) {
    const double t = static_cast<double>(i) / steps;
    return t * t * length;
  };
  for (int i = 0; i < steps; ++i) visit(0.5 * (end(i) + end(i + 1)), end(i + 1) - end(i));
}

/// What sunlight meets.
class Air {
public:
  explicit Air(const Atmosphere& a) : haze_(haze(a.turbidity)) {
    const double e = a.elevation * pi / 180.0;
    const double z = a.azimuth * pi / 180.0;
    sun_ = Vec(std::cos(e) * std::sin(z), std::sin(e), -std::cos(e) * std::cos(z));
  }

  const Vec& sun() const { return sun_; }

  Array sunlight(const Vec& x) const { return sunlight(x, sun_); }

  /// What is left at a point of light from a sun; haze also absorbs a tenth of what it takes.
  Array sunlight(const Vec& x, const Vec& sun) const {
    if (meets_earth(x, sun)) return Array::Zero();
    Column column;
    march(exit_distance(x, sun, top), 24,
          [&](double middle, double step) { column.add((x + middle * sun).norm() - earth, step); });
    return through(column);
  }

protected:
  Array through(const Column& c) const {
    return (-(air * c.air + Array::Constant(haze_ / 0.9 * c.haze) + ozone * c.ozone)).exp();
  }
  /// Along a way from a point: calls for each step with its middle, its length times what is left of light
  /// from there [m], and what of it air and haze scatter [1/m]. What all of the way takes.
  Column scatter(const Vec& from, const Vec& d, double length, int steps, const auto& visit) const {
    Column column;
    march(length, steps, [&](double middle, double step) {
      const Vec x = from + middle * d;
      const double height = x.norm() - earth;
      Column half = column;
      half.add(height, 0.5 * step);
      column.add(height, step);
      visit(x, step * through(half), Array(air * std::exp(-height / air_height)),
            haze_ * std::exp(-height / haze_height));
    });
    return column;
  }

  double haze_;
  Vec sun_;
};

/// The light of its sky.
class SkyLight : public Air {
public:
  explicit SkyLight(const Atmosphere& a) : Air(a) {
    for (int i = 0; i < heights; ++i) {
      for (int k = 0; k < cosines; ++k) multiple_[cell_of(i, k)] = multiple_at(height_of(i), cosine_of(k));
    }
  }

  Array radiance(const Vec& d) const {
    const Vec eye(0.0, earth + 2.0, 0.0);
    const double c = d.dot(sun_);
    const double of_air = 3.0 / (16.0 * pi) * (1.0 + c * c);
    const double g = haze_forward;
    const double of_haze =
        3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + c * c) /
        ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * c, 1.5));  // [Cornette and Shanks 1992]
    Array sum = Array::Zero();
    scatter(eye, d, exit_distance(eye, d, top), 40,
            [&](const Vec& x, const Array& left, const Array& air_here, double haze_here) {
              const Array once = (air_here * of_air + haze_here * of_haze) * sunlight(x);
              const Array again =
                  (air_here + haze_here) * multiple(x.norm() - earth, x.normalized().dot(sun_));
              sum += left * (once + again);
            });
    return sum;
  }

private:
  // The sun stands as high as at the eye, but for the Earth's curvature along the line of sight.
  static constexpr int heights = 16, cosines = 8;
  static constexpr std::size_t cells = std::size_t{heights} * cosines;
  static constexpr double cosine_range = 0.15;
  static std::size_t cell_of(int i, int k) {
    return static_cast<std::size_t>(i) * cosines + static_cast<std::size_t>(k);
  }
  static double height_of(double i) { return (top - earth) * i * i / ((heights - 1) * (heights - 1)); }
  double cosine_of(int k) const {
    return std::clamp(sun_.y() + cosine_range * (2.0 * k / (cosines - 1) - 1.0), -1.0, 1.0);
  }

  /// Light that was scattered twice and more, from all sides alike, for a sun of this cosine over a point:
  /// what the second order brings over 1 - f, f the part of it that each further order keeps [Hillaire 2020,
  /// Eqs. 5 to 10].
  Array multiple_at(double height, double cosine) const {
    constexpr int around = 8;
    const Vec from(0.0, earth + std::max(height, 1.0), 0.0);
    const Vec sun(std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), cosine, 0.0);
    Array second = Array::Zero(), kept = Array::Zero();
    for (int i = 0; i < around * around; ++i) {
      const int row = i / around;
      const double y = 1.0 - (2.0 * row + 1.0) / around;
      const double phi = 2.0 * pi * (i % around + 0.5) / around;
      const double across = std::sqrt(1.0 - y * y);
      const Vec d(across * std::cos(phi), y, across * std::sin(phi));
      const bool down = meets_earth(from, d);
      const double length = down ? entry_distance(from, d, earth) : exit_distance(from, d, top);
      const Column column = scatter(
          from, d, length, 20, [&](const Vec& x, const Array& left, const Array& air_here, double haze_here) {
            const Array part = left * (air_here + haze_here);
            kept += part;
            second += part * sunlight(x, sun) / (4.0 * pi);
          });
      if (!down) continue;
      const Vec ground = from + length * d;
      const double facing = std::max(ground.normalized().dot(sun), 0.0);
      second += through(column) * (ground_albedo / pi * facing) * sunlight(ground * (1.0 + 1e-7), sun);
    }
    constexpr double mean = 1.0 / (around * around);
    return second * mean / (1.0 - kept * mean);
  }

  Array multiple(double height, double cosine) const {
    const double x = std::clamp(std::sqrt(std::max(height, 0.0) / (top - earth)), 0.0, 1.0) * (heights - 1);
    const double y =
        std::clamp((cosine - sun_.y() + cosine_range) / (2.0 * cosine_range), 0.0, 1.0) * (cosines - 1);
    const int i = std::min(static_cast<int>(x), heights - 2);
    const int k = std::min(static_cast<int>(y), cosines - 2);
    const auto at = [&](int a, int b) { return multiple_[cell_of(a, b)]; };
    const double fx = x - i, fy = y - k;
    return (1.0 - fx) * ((1.0 - fy) * at(i, k) + fy * at(i, k + 1)) +
           fx * ((1.0 - fy) * at(i + 1, k) + fy * at(i + 1, k + 1));
  }

  std::array<Array, cells> multiple_;
};

}  // namespace

SkyMap atmosphere_map(const Atmosphere& a, int width, int height) {
  const SkyLight light(a);
  std::vector<Color> texels;
  texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const double theta = std::min(pi * (y + 0.5) / height, 0.4995 * pi);
    for (int x = 0; x < width; ++x) {
      const double phi = 2.0 * pi * ((x + 0.5) / width - 0.5);
      const Vec d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
      texels.push_back(light.radiance(d).cast<float>());
    }
  }
  return {width, height, std::move(texels)};
}

Sun atmosphere_sun(const Atmosphere& a) {
  const Air air_around(a);
  Sun sun;
  sun.direction = (-air_around.sun()).cast<float>();
  sun.color = air_around.sunlight(Vec(0.0, earth + 2.0, 0.0)).cast<float>();
  sun.irradiance = 1.0F;
  sun.visible = true;
  return sun;
}

}  // namespace lagomorph::render
