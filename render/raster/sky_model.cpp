#include "render/raster/sky_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/path/sheen.h"

namespace lagomorph::render::raster {
namespace {

using std::numbers::pi;
constexpr double golden_angle = pi * (3.0 - 2.23606797749978969);

/// Integral of max(a cos(phi) + b, 0) over a turn, a >= 0.
double clipped_cosine(double a, double b) {
  if (b >= a) return 2.0 * pi * b;
  if (b <= -a) return 0.0;
  const double phi = std::acos(-b / a);
  return 2.0 * (a * std::sin(phi) + b * phi);
}

}  // namespace

SkyIrradiance sky_irradiance(float normal_y) {
  // Over the height y = t^2 of the direction, so that the zenith's weight sqrt(y) is smooth: d omega = 2 t dt
  // d phi.
  const double ny = std::clamp(static_cast<double>(normal_y), -1.0, 1.0);
  const double across = std::sqrt(1.0 - ny * ny);
  constexpr int steps = 512;
  double zenith = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    const double y = t * t;
    zenith += clipped_cosine(across * std::sqrt(1.0 - y * y), ny * y) * t * 2.0 * t / steps;
  }
  const double all = pi * (1.0 + ny) / 2.0;
  return {static_cast<float>(all - zenith), static_cast<float>(zenith)};
}

std::vector<SkyIrradiance> sky_irradiance_table(int entries) {
  std::vector<SkyIrradiance> table;
  table.reserve(static_cast<std::size_t>(entries));
  for (int i = 0; i < entries; ++i)
    table.push_back(sky_irradiance(2.0F * static_cast<float>(i) / static_cast<float>(entries - 1) - 1.0F));
  return table;
}

std::vector<CoatTableEntry> coat_albedo_table(int entries) {
  std::vector<CoatTableEntry> table;
  const float step = 1.0F / static_cast<float>(entries);
  for (int r = 0; r < entries; ++r) {
    const std::size_t row = table.size();
    CoatAlbedo mean{0.0F, 0.0F};
    for (int c = 0; c < entries; ++c) {
      const float cosine = (static_cast<float>(c) + 0.5F) * step;
      const CoatAlbedo a = coat_albedo(cosine, (static_cast<float>(r) + 0.5F) * step);
      mean.scale += 2.0F * a.scale * cosine * step;
      mean.offset += 2.0F * a.offset * cosine * step;
      table.push_back({a, {}});
    }
    for (std::size_t i = row; i < table.size(); ++i) table[i].mean = mean;
  }
  return table;
}

std::vector<SheenTableEntry> sheen_table(std::span<const float> roughnesses, int entries) {
  std::vector<SheenTableEntry> table;
  for (const float roughness : roughnesses) {
    const path::Sheen sheen(roughness);
    for (int k = 0; k < entries; ++k) {
      const float cosine = static_cast<float>(k) / static_cast<float>(entries - 1);
      table.push_back({sheen.albedo(cosine), sheen.power(), sheen.scale(), 0.0F});
    }
  }
  return table;
}

std::array<SkyDirectionBlock, most_sky_directions> sky_directions(const Sky& sky) {
  std::array<SkyDirectionBlock, most_sky_directions> blocks;
  for (int i = 0; i < most_sky_directions; ++i) {
    const double y = (i + 0.5) / most_sky_directions;
    const double across = std::sqrt(1.0 - y * y);
    const double phi = golden_angle * i;
    const Vec3 direction(static_cast<float>(across * std::cos(phi)), static_cast<float>(y),
                         static_cast<float>(across * std::sin(phi)));
    const Vec3 right(static_cast<float>(-std::sin(phi)), 0.0F, static_cast<float>(std::cos(phi)));
    const Vec3 up = direction.cross(right);
    SkyDirectionBlock& block = blocks[static_cast<std::size_t>(i)];
    block.right = vec4(right, 0.0F);
    block.up = vec4(up, 0.0F);
    block.direction = vec4(direction, 0.0F);
    block.radiance = vec4(sky_radiance(sky, direction), 0.0F);
  }
  return blocks;
}

}  // namespace lagomorph::render::raster
