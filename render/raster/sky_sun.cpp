#include "render/raster/sky_sun.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace lagomorph::render::raster {
namespace {

using std::numbers::pi;
using Vec3d = Eigen::Vector3d;
using Color3d = Eigen::Array3d;

constexpr double least_share_of_sky = 0.05;         // of the light from above the horizon
constexpr double widest_radius = 9.0 * pi / 180.0;  // of the patch
constexpr double least_of_peak = 0.05;  // of the brightest texel's luminance: what is connected to that
constexpr double least_contrast = 5.0;  // of the patch's mean luminance to what surrounds it
// Of the patch's mean squared radius to that of a disc of its area: 1.05 for a square, 1.75 for one by three.
constexpr double most_stretch = 1.5;

double luminance_of(const Color3d& c) { return 0.2126 * c.x() + 0.7152 * c.y() + 0.0722 * c.z(); }

/// A map's texels as directions and solid angles.
class Texels {
public:
  explicit Texels(const SkyMap& map) : map_(map) {}

  int width() const { return map_.width(); }
  int height() const { return map_.height(); }
  double step() const { return pi / height(); }
  double solid_angle(int y) const {
    return 2.0 * pi / width() * (std::cos(step() * y) - std::cos(step() * (y + 1)));
  }
  Vec3d direction(int x, int y) const {
    return map_.direction((x + 0.5) / width(), (y + 0.5) / height()).cast<double>();
  }
  Color3d radiance(int x, int y) const { return map_.texel(x, y).cast<double>(); }
  double luminance(int x, int y) const { return luminance_of(radiance(x, y)); }

  /// Calls texel(x, y, direction) for those whose middles are within an angle of a direction.
  template <class Texel>
  void for_each_within(const Vec3d& middle, double angle, const Texel& texel) const {
    const double down = std::acos(std::clamp(middle.y(), -1.0, 1.0));
    const int first = std::max(static_cast<int>((down - angle) / step()) - 1, 0);
    const int last = std::min(static_cast<int>((down + angle) / step()) + 1, height() - 1);
    const double least = std::cos(angle), around_pole = std::sin(down);
    // Columns to either side; all where a pole is within.
    const double turns =
        std::sin(angle) < around_pole ? std::asin(std::sin(angle) / around_pole) / (2.0 * pi) : 1.0;
    const int reach = std::min(static_cast<int>(turns * width()) + 2, width() / 2);
    const int column = static_cast<int>(map_.place(middle.cast<float>()).x() * static_cast<float>(width()));
    const int columns = std::min(2 * reach + 1, width());
    for (int y = first; y <= last; ++y) {
      for (int k = 0; k < columns; ++k) {
        const int x = (column - reach + k + width()) % width();
        const Vec3d d = direction(x, y);
        if (d.dot(middle) >= least) texel(x, y, d);
      }
    }
  }

private:
  const SkyMap& map_;
};

struct Peak {
  int x = 0, y = 0;
  double luminance = 0.0;
};

/// The brightest texel above the horizon, and the light of all of these [by luminance, W/m^2].
std::pair<Peak, double> brightest(const Texels& texels) {
  Peak peak;
  double light = 0.0;
  for (int y = 0; y < texels.height() / 2; ++y) {
    double row = 0.0;
    for (int x = 0; x < texels.width(); ++x) {
      const double luminance = texels.luminance(x, y);
      row += luminance;
      if (luminance > peak.luminance) peak = {x, y, luminance};
    }
    light += texels.solid_angle(y) * row;
  }
  return {peak, light};
}

struct Disc {
  Vec3d middle;
  double radius;  // [radians]
  double area;    // of the texels that it was laid around [sr]
};

/// Around all that is connected to the brightest texel; none where that goes on beyond the widest.
std::optional<Disc> disc_around(const Texels& texels, const Peak& peak) {
  const int width = texels.width(), height = texels.height();
  const Vec3d top = texels.direction(peak.x, peak.y);
  const double least = least_of_peak * peak.luminance, within = std::cos(2.0 * widest_radius);
  std::vector<bool> seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), false);
  std::vector<std::pair<int, int>> found;
  bool goes_on = false;
  const auto visit = [&](int x, int y) {
    if (y < 0 || y >= height) return;
    x = (x + width) % width;
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    if (seen[i] || texels.luminance(x, y) < least) return;
    seen[i] = true;
    goes_on |= texels.direction(x, y).dot(top) < within;
    found.emplace_back(x, y);
  };
  visit(peak.x, peak.y);
  Vec3d sum = Vec3d::Zero();
  double area = 0.0;
  for (std::size_t k = 0; k < found.size() && !goes_on; ++k) {
    const auto [x, y] = found[k];
    sum += texels.solid_angle(y) * texels.luminance(x, y) * texels.direction(x, y);
    area += texels.solid_angle(y);
    for (const int side : {-1, 1}) {
      visit(x + side, y);
      visit(x, y + side);
    }
  }
  if (goes_on) return std::nullopt;
  const Vec3d middle = sum.normalized();
  double radius = 0.0;
  for (const auto& [x, y] : found)
    radius = std::max(radius, std::acos(std::min(middle.dot(texels.direction(x, y)), 1.0)));
  radius += 1.5 * texels.step();
  if (radius > widest_radius || middle.y() <= std::sin(radius)) return std::nullopt;
  return Disc{middle, radius, area};
}

/// Mean radiance of a ring around a disc.
Color3d surroundings(const Texels& texels, const Disc& disc) {
  Color3d sum = Color3d::Zero();
  double all = 0.0;
  const double inside = std::cos(disc.radius);
  texels.for_each_within(disc.middle, 1.5 * disc.radius + 2.0 * texels.step(),
                         [&](int x, int y, const Vec3d& d) {
                           if (d.dot(disc.middle) >= inside) return;
                           const double angle = texels.solid_angle(y);
                           sum += angle * texels.radiance(x, y);
                           all += angle;
                         });
  return sum / std::max(all, 1e-12);
}

}  // namespace

std::optional<SkySun> sun_of_sky(const Sky& sky) {
  if (!sky.map || !(sky.strength > 0.0F)) return std::nullopt;
  const SkyMap& map = *sky.map;
  const Texels texels(map);
  const auto [peak, light] = brightest(texels);
  // The widest patch of the brightest texel's radiance.
  if (peak.luminance * pi * widest_radius * widest_radius < least_share_of_sky * light || !(light > 0.0))
    return std::nullopt;
  const std::optional<Disc> disc = disc_around(texels, peak);
  if (!disc) return std::nullopt;

  const Color3d around = surroundings(texels, *disc);
  Vec3d towards = Vec3d::Zero();
  double taken = 0.0;
  const auto more = [&](int x, int y) { return Color3d((texels.radiance(x, y) - around).max(0.0)); };
  texels.for_each_within(disc->middle, disc->radius, [&](int x, int y, const Vec3d& d) {
    const double part = texels.solid_angle(y) * luminance_of(more(x, y));
    towards += part * d;
    taken += part;
  });
  if (taken < least_share_of_sky * light || taken < least_contrast * disc->area * luminance_of(around))
    return std::nullopt;
  towards.normalize();

  std::vector<Color> rest = map.texels();
  Color3d irradiance = Color3d::Zero();  // on what faces it
  double squares = 0.0;
  texels.for_each_within(disc->middle, disc->radius, [&](int x, int y, const Vec3d& d) {
    const Color3d part = texels.solid_angle(y) * more(x, y);
    irradiance += part * d.dot(towards);
    squares += luminance_of(part) * (d - towards).squaredNorm();
    Color& texel = rest[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width()) +
                        static_cast<std::size_t>(x)];
    texel = texel.min(around.cast<float>());
  });
  squares /= taken;
  if (squares > most_stretch * disc->area / (2.0 * pi)) return std::nullopt;
  // Each texel is bilinear: a tent of this mean square either way.
  const double across =
      2.0 * texels.step() * texels.height() / map.width() * std::sqrt(1.0 - towards.y() * towards.y());
  squares += (across * across + texels.step() * texels.step()) / 6.0;

  SkySun found;
  found.sun.direction = -towards.cast<float>();
  // On a disc half of its squared radius is the mean square, by chords on the sphere as well.
  found.sun.angle =
      static_cast<float>(std::max(4.0 * std::asin(0.5 * std::sqrt(2.0 * squares)) * 180.0 / pi, 0.01));
  const double most = irradiance.maxCoeff();
  found.sun.color = (irradiance / most).cast<float>();
  found.sun.irradiance = sky.strength * static_cast<float>(most);
  found.sun.name = "the sky's sun";
  found.rest =
      std::make_shared<const SkyMap>(map.width(), map.height(), std::move(rest), 360.0F * map.turn());
  return found;
}

}  // namespace lagomorph::render::raster
