#include "render/raster/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/raster/sky_model.h"

namespace lagomorph::render::raster {
namespace {

using std::numbers::pi;

constexpr int lobe_size = 128;         // of a face, of the sharpest lobes
constexpr int source_size = 32;        // of what irradiance and directions are summed over
constexpr int irradiance_size = 16;    // of a face
constexpr int widest_map = 1024;       // that the cube's texels are sampled from
constexpr float lowest_sight = 0.02F;  // height of a direction that is looked along

/// Radiance from above the horizon, 1 there, from below, and a blank.
using Halves = Eigen::Array<float, 8, 1>;

/// Mean over each texel of 3 x 3 points. The horizon lies between texels.
CubeMap<Halves> sampled(const SkyMap& map, float strength) {
  CubeMap<Halves> cube(lobe_size);
  tbb::parallel_for(tbb::blocked_range<int>(0, 6 * lobe_size), [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) {
      const int face = row / lobe_size, y = row % lobe_size;
      for (int x = 0; x < lobe_size; ++x) {
        Color sum = Color::Zero();
        float height = 0.0F;
        for (int k = 0; k < 9; ++k) {
          const int down = k / 3, across = k % 3;
          const float s = (static_cast<float>(x) + (static_cast<float>(across) + 0.5F) / 3.0F) / lobe_size;
          const float t = (static_cast<float>(y) + (static_cast<float>(down) + 0.5F) / 3.0F) / lobe_size;
          const Vec3 d = cube_point(face, 2.0F * s - 1.0F, 2.0F * t - 1.0F).normalized();
          sum += map.radiance(d);
          height += d.y();
        }
        sum *= strength / 9.0F;
        Halves& texel = cube.at(face, x, y);
        texel.setZero();
        texel.segment<3>(height > 0.0F ? 0 : 4) = sum;
        texel[3] = height > 0.0F ? 1.0F : 0.0F;
      }
    }
  });
  return cube;
}

CubeMap<Halves> halved(const CubeMap<Halves>& fine) {
  CubeMap<Halves> coarse(fine.size() / 2);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < coarse.size(); ++y) {
      for (int x = 0; x < coarse.size(); ++x) {
        Halves sum = Halves::Zero();
        double all = 0.0;
        for (int k = 0; k < 4; ++k) {
          const int i = 2 * x + k % 2, j = 2 * y + k / 2;
          const double angle = cube_texel_solid_angle(fine.size(), i, j);
          sum += static_cast<float>(angle) * fine.at(face, i, j);
          all += angle;
        }
        coarse.at(face, x, y) = sum / static_cast<float>(all);
      }
    }
  }
  return coarse;
}

/// The texel at (x, y), or beyond the face's border the one that lies there on another.
const Halves& texel_near(const CubeMap<Halves>& cube, int face, int x, int y) {
  const int n = cube.size();
  if (x >= 0 && x < n && y >= 0 && y < n) return cube.at(face, x, y);
  const CubePlace p = cube_place(cube_texel_point(n, face, x, y));
  const auto index = [n](float s) {
    return std::clamp(static_cast<int>(0.5F * (s + 1.0F) * static_cast<float>(n)), 0, n - 1);
  };
  return cube.at(p.face, index(p.s), index(p.t));
}

Halves bilinear(const CubeMap<Halves>& cube, const Vec3& direction) {
  const CubePlace p = cube_place(direction);
  const auto n = static_cast<float>(cube.size());
  const float x = 0.5F * (p.s + 1.0F) * n - 0.5F, y = 0.5F * (p.t + 1.0F) * n - 0.5F;
  const float left = std::floor(x), top = std::floor(y);
  const int i = static_cast<int>(left), j = static_cast<int>(top);
  const float u = x - left, v = y - top;
  return (1.0F - v) * ((1.0F - u) * texel_near(cube, p.face, i, j) + u * texel_near(cube, p.face, i + 1, j)) +
         v * ((1.0F - u) * texel_near(cube, p.face, i, j + 1) + u * texel_near(cube, p.face, i + 1, j + 1));
}

/// A direction of a lobe around z, where its solid angle is looked up, and its weight.
struct LobeSample {
  Vec3 direction;
  int level;
  float blend;  // with the next level
  float weight;
};

/// GGX half vectors by their density, the normal along the view [Karis 2013], each over its share of the
/// sphere [Krivanek and Colbert 2008].
std::vector<LobeSample> lobe_samples(float roughness, int count, int levels) {
  const double a2 = std::pow(static_cast<double>(roughness), 4.0);
  const double texel = 4.0 * pi / (6.0 * lobe_size * lobe_size);
  std::vector<LobeSample> samples;
  double total = 0.0;
  for (int i = 0; i < count; ++i) {
    const double u = (i + 0.5) / count;
    const double phi = 2.0 * pi * std::fmod(i * 0.6180339887498949, 1.0);
    const double h2 = (1.0 - u) / (1.0 + (a2 - 1.0) * u);  // squared cosine of the half vector
    const double hz = std::sqrt(h2), across = std::sqrt(1.0 - h2);
    const double z = 2.0 * h2 - 1.0;
    if (z <= 0.0) continue;
    const double k = h2 * (a2 - 1.0) + 1.0;
    const double density = a2 / (pi * k * k) / 4.0;  // of the reflected direction
    const double level =
        std::clamp(0.5 * std::log2(1.0 / (count * density * texel)) + 0.5, 0.0, levels - 1.001);
    samples.push_back({Vec3(static_cast<float>(2.0 * hz * across * std::cos(phi)),
                            static_cast<float>(2.0 * hz * across * std::sin(phi)), static_cast<float>(z)),
                       static_cast<int>(level), static_cast<float>(level - std::floor(level)),
                       static_cast<float>(z)});
    total += z;
  }
  for (LobeSample& s : samples) s.weight /= static_cast<float>(total);
  return samples;
}

CubeMap<Halves> lobes(const std::vector<CubeMap<Halves>>& source, int size, float roughness, int count) {
  const std::vector<LobeSample> samples = lobe_samples(roughness, count, static_cast<int>(source.size()));
  CubeMap<Halves> cube(size);
  tbb::parallel_for(tbb::blocked_range<int>(0, 6 * size), [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row != rows.end(); ++row) {
      const int face = row / size, y = row % size;
      for (int x = 0; x < size; ++x) {
        const Vec3 z = cube_texel_point(size, face, x, y).normalized();
        const Vec3 a = z.unitOrthogonal(), b = z.cross(a);
        Halves sum = Halves::Zero();
        for (const LobeSample& s : samples) {
          const Vec3 d = s.direction.x() * a + s.direction.y() * b + s.direction.z() * z;
          const auto level = static_cast<std::size_t>(s.level);
          sum += s.weight *
                 ((1.0F - s.blend) * bilinear(source[level], d) + s.blend * bilinear(source[level + 1], d));
        }
        cube.at(face, x, y) = sum;
      }
    }
  });
  return cube;
}

CubeMap<Vec4> half_of(const CubeMap<Halves>& cube, int first) {
  CubeMap<Vec4> half(cube.size());
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < cube.size(); ++y) {
      for (int x = 0; x < cube.size(); ++x)
        half.at(face, x, y) = cube.at(face, x, y).segment<4>(first).matrix();
    }
  }
  return half;
}

/// A texel of the source as a direction with its light.
struct SkyRay {
  Vec3 direction;
  float solid_angle;  // [sr]
  Halves radiance;
};

std::vector<SkyRay> rays_of(const CubeMap<Halves>& cube) {
  std::vector<SkyRay> rays;
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < cube.size(); ++y) {
      for (int x = 0; x < cube.size(); ++x) {
        rays.push_back({cube_texel_point(cube.size(), face, x, y).normalized(),
                        static_cast<float>(cube_texel_solid_angle(cube.size(), x, y)), cube.at(face, x, y)});
      }
    }
  }
  return rays;
}

void add_irradiance(const std::vector<SkyRay>& rays, SkyLight& light) {
  tbb::parallel_for(tbb::blocked_range<int>(0, 6 * irradiance_size),
                    [&](const tbb::blocked_range<int>& rows) {
                      for (int row = rows.begin(); row != rows.end(); ++row) {
                        const int face = row / irradiance_size, y = row % irradiance_size;
                        for (int x = 0; x < irradiance_size; ++x) {
                          const Vec3 n = cube_texel_point(irradiance_size, face, x, y).normalized();
                          Halves sum = Halves::Zero();
                          float below = 1e-6F;
                          for (const SkyRay& ray : rays) {
                            const float cosine = ray.solid_angle * std::max(n.dot(ray.direction), 0.0F);
                            sum += cosine * ray.radiance;
                            below += (1.0F - ray.radiance[3]) * cosine;
                          }
                          light.irradiance_above.at(face, x, y) = sum.head<4>().matrix();
                          light.radiance_below.at(face, x, y) = (sum.tail<4>() / below).matrix();
                        }
                      }
                    });
}

/// k-means of the upper half from the even directions of sky_directions(), weighed half by light and half by
/// solid angle.
std::array<SkyDirectionBlock, most_sky_directions> bright_directions(const std::vector<SkyRay>& rays) {
  std::array<SkyDirectionBlock, most_sky_directions> blocks = sky_directions(Sky{});
  std::array<Vec3, most_sky_directions> middles;
  for (std::size_t i = 0; i < middles.size(); ++i) middles[i] = blocks[i].direction.head<3>();
  const auto light_of = [](const SkyRay& ray) {
    return ray.solid_angle *
           (0.2126F * ray.radiance[0] + 0.7152F * ray.radiance[1] + 0.0722F * ray.radiance[2]);
  };
  double all = 0.0;
  for (const SkyRay& ray : rays) all += static_cast<double>(light_of(ray));
  const auto nearest = [&](const Vec3& d) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < middles.size(); ++i) {
      if (middles[i].dot(d) > middles[best].dot(d)) best = i;
    }
    return best;
  };
  const float per_light = all > 0.0 ? static_cast<float>(2.0 * pi / all) : 0.0F;
  constexpr int rounds = 24;
  for (int round = 0; round <= rounds; ++round) {
    // The last one by light alone, but for a trace, and for good.
    const float even = round < rounds ? 1.0F : 1e-3F;
    std::array<Vec3, most_sky_directions> sums;
    std::array<float, most_sky_directions> weights{};
    std::array<Color, most_sky_directions> energy;
    sums.fill(Vec3::Zero());
    energy.fill(Color::Zero());
    for (const SkyRay& ray : rays) {
      if (ray.direction.y() <= 0.0F) continue;
      const std::size_t i = nearest(ray.direction);
      const float weight = per_light * light_of(ray) + even * ray.solid_angle;
      sums[i] += weight * ray.direction;
      weights[i] += weight;
      energy[i] += ray.solid_angle * ray.radiance.head<3>();
    }
    for (std::size_t i = 0; i < middles.size(); ++i) {
      blocks[i].radiance.setZero();
      if (weights[i] <= 0.0F) continue;
      middles[i] = sums[i].normalized();
      if (round < rounds) continue;
      middles[i].y() = std::max(middles[i].y(), lowest_sight);
      middles[i].normalize();
      // Of points around their middle: 1 - |mean|^2 is their mean squared distance, half of R^2 on a disc.
      const float spread = std::sqrt(2.0F * std::max(1.0F - (sums[i] / weights[i]).squaredNorm(), 0.0F));
      const Vec3 right = Vec3(-middles[i].z(), 0.0F, middles[i].x()).normalized();
      SkyDirectionBlock& block = blocks[i];
      block.direction = vec4(middles[i], std::clamp(spread, 0.02F, 0.5F));
      block.right = vec4(right.allFinite() && right.norm() > 0.5F ? right : Vec3(Vec3::UnitX()), 0.0F);
      block.up = vec4(Vec3(middles[i].cross(Vec3(block.right.head<3>()))), 0.0F);
      block.radiance = vec4(energy[i], 0.0F);
    }
  }
  return blocks;
}

}  // namespace

SkyMap reduced(const SkyMap& map, int most_width) {
  const int factor = (map.width() + most_width - 1) / most_width;
  if (factor <= 1) return map;
  const int width = (map.width() + factor - 1) / factor, height = (map.height() + factor - 1) / factor;
  std::vector<Color> texels;
  texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const int y0 = y * map.height() / height, y1 = std::max((y + 1) * map.height() / height, y0 + 1);
    for (int x = 0; x < width; ++x) {
      const int x0 = x * map.width() / width, x1 = std::max((x + 1) * map.width() / width, x0 + 1);
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      double all = 0.0;
      for (int j = y0; j < y1; ++j) {
        const double weight = std::sin(pi * (j + 0.5) / map.height());
        for (int i = x0; i < x1; ++i) sum += weight * map.texel(i, j).cast<double>();
        all += weight * (x1 - x0);
      }
      texels.emplace_back((sum / all).cast<float>());
    }
  }
  return {width, height, std::move(texels), 360.0F * map.turn()};
}

SkyLight sky_light(const Sky& sky) {
  SkyLight light{CubeMap<Vec4>(irradiance_size), CubeMap<Vec4>(irradiance_size), {}, {}, {}};
  std::vector<CubeMap<Halves>> source = {sampled(reduced(*sky.map, widest_map), sky.strength)};
  while (source.back().size() > 1) source.push_back(halved(source.back()));
  for (int level = 0; level < sky_lobe_levels; ++level) {
    const float roughness = static_cast<float>(level) / (sky_lobe_levels - 1);
    const CubeMap<Halves> filtered =
        level == 0 ? source[0] : lobes(source, lobe_size >> level, roughness, level == 1 ? 64 : 256);
    light.lobes_above.push_back(half_of(filtered, 0));
    light.lobes_below.push_back(half_of(filtered, 4));
  }
  const std::vector<SkyRay> rays = rays_of(source[2]);
  static_assert(lobe_size >> 2 == source_size);
  add_irradiance(rays, light);
  light.directions = bright_directions(rays);
  return light;
}

}  // namespace lagomorph::render::raster
