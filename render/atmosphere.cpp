#include "render/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace lagomorph::render {
namespace {

using Array = Eigen::Array3d;
using Vec = Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
constexpr double earth = 6.36e6;    // radius [m]
constexpr double top = 6.42e6;      // of the air
constexpr double air_height = 8e3;  // in which its density falls to 1/e [m]
constexpr double haze_height = 1.2e3;
constexpr double haze_forward = 0.76;             // g of its phase function
const Array air(5.8e-6, 13.5e-6, 33.1e-6);        // scattering at the ground [1/m]
const Array ozone(0.650e-6, 1.881e-6, 0.085e-6);  // absorption in its layer [1/m]

/// Of haze at the ground: none at turbidity 1, some 4e-6 at 2 [1/m].
double haze(double turbidity) { return 4e-6 * (turbidity - 1.0); }

/// Distance to a sphere around the origin from inside it.
double exit_distance(const Vec& x, const Vec& d, double radius) {
  const double b = x.dot(d);
  return -b + std::sqrt(std::max(b * b - x.squaredNorm() + radius * radius, 0.0));
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

class Air {
public:
  explicit Air(const Atmosphere& a) : haze_(haze(a.turbidity)) {
    const double e = a.elevation * pi / 180.0;
    const double z = a.azimuth * pi / 180.0;
    sun_ = Vec(std::cos(e) * std::sin(z), std::sin(e), -std::cos(e) * std::cos(z));
  }

  const Vec& sun() const { return sun_; }

  /// What is left of sunlight at a point; haze also absorbs a tenth of what it takes.
  Array sunlight(const Vec& x) const {
    if (meets_earth(x, sun_)) return Array::Zero();
    constexpr int steps = 24;
    const double length = exit_distance(x, sun_, top);
    Column column;
    // Steps grow as squares: the air is dense near the ground.
    for (int i = 0; i < steps; ++i) {
      const double a = square(i, steps) * length;
      const double b = square(i + 1, steps) * length;
      column.add((x + 0.5 * (a + b) * sun_).norm() - earth, b - a);
    }
    return through(column);
  }

  Array radiance(const Vec& d) const {
    constexpr int steps = 40;
    const Vec eye(0.0, earth + 2.0, 0.0);
    const double length = exit_distance(eye, d, top);
    const double c = d.dot(sun_);
    const double of_air = 3.0 / (16.0 * pi) * (1.0 + c * c);
    const double g = haze_forward;
    const double of_haze =
        3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + c * c) /
        ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * c, 1.5));  // [Cornette and Shanks 1992]
    Column column;
    Array sum = Array::Zero();
    for (int i = 0; i < steps; ++i) {
      const double a = square(i, steps) * length;
      const double b = square(i + 1, steps) * length;
      const Vec x = eye + 0.5 * (a + b) * d;
      const double height = x.norm() - earth;
      Column half = column;
      half.add(height, 0.5 * (b - a));
      column.add(height, b - a);
      const Array scattered =
          air * (of_air * std::exp(-height / air_height)) + haze_ * of_haze * std::exp(-height / haze_height);
      sum += (b - a) * scattered * through(half) * sunlight(x);
    }
    return sum;
  }

private:
  static double square(int i, int steps) {
    const double t = static_cast<double>(i) / steps;
    return t * t;
  }
  Array through(const Column& c) const {
    return (-(air * c.air + Array::Constant(haze_ / 0.9 * c.haze) + ozone * c.ozone)).exp();
  }

  double haze_;
  Vec sun_;
};

}  // namespace

SkyMap atmosphere_map(const Atmosphere& a, int width, int height) {
  const Air air_around(a);
  std::vector<Color> texels;
  texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const double theta = std::min(pi * (y + 0.5) / height, 0.4995 * pi);
    for (int x = 0; x < width; ++x) {
      const double phi = 2.0 * pi * ((x + 0.5) / width - 0.5);
      const Vec d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
      texels.push_back(air_around.radiance(d).cast<float>());
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
