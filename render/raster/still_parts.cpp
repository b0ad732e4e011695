#include "render/raster/still_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <tbb/parallel_for.h>

#include "render/raster/half.h"
#include "render/raster/pixel_ray.h"
#include "render/simd.h"

namespace lagomorph::render::raster {
namespace {

constexpr int cell = 4;           // pixels between points at which the ground's map is looked up
constexpr int most_pixels = 256;  // of a row at once

/// The mean over half a texel to all sides counts the four pixels of a quad alike, wherever it is, so that
/// nothing is left of their different points. All of it beyond the map.
Color seen_at(const GroundSeen& map, const Vec2& at) {
  if ((at.array() < 0.0F).any() || (at.array() > 1.0F).any()) return Color::Ones();
  struct Weights {
    int first;
    std::array<float, 3> of;
  };
  const auto weights = [&](float x) {
    const float texel = x * static_cast<float>(map.size) - 0.5F, nearest = std::floor(texel + 0.5F);
    const float beside = texel - nearest;
    return Weights{static_cast<int>(nearest) - 1, {0.25F - 0.5F * beside, 0.5F, 0.25F + 0.5F * beside}};
  };
  const Weights x = weights(at.x()), y = weights(at.y());
  Color sum = Color::Zero();
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int tx = std::clamp(x.first + static_cast<int>(i), 0, map.size - 1);
      const int ty = std::clamp(y.first + static_cast<int>(j), 0, map.size - 1);
      const int texel = ty * map.size + tx;
      sum += y.of[j] * x.of[i] * map.texels[static_cast<std::size_t>(texel)];
    }
  }
  return sum;
}

/// Part of a row of pixels that the taking works on.
struct TakenRow {
  int count;
  const std::uint16_t* planes;  // of the row's first pixel
  std::size_t plane;            // from one to the next
  int lights;
  const Parts* lit;                  // nullptr: all lights are seen
  std::array<const float*, 3> seen;  // of the sky
  float mirrored;                    // 0: nothing of what the ground mirrors is taken
  float* color;
};

LAGOMORPH_RENDER_SIMD void take(const TakenRow& r, const Color& open_sky, const Color& below,
                                const Color& of_meshes) {
  alignas(64) std::array<std::array<float, most_pixels>, most_lights> hidden;
  alignas(64) std::array<float, most_pixels> taken;
  const auto count = static_cast<std::size_t>(r.count);
  if (r.lit != nullptr) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(r.lights); ++i) {
      for (std::size_t x = 0; x < count; ++x)
        hidden[i][x] = 1.0F - static_cast<float>(r.lit[x][i]) * (1.0F / 65535.0F);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint16_t* diffuse = r.planes + c * r.plane;
    const std::uint16_t* mirrored = r.planes + (3 + c) * r.plane;
    const float* seen = r.seen[c];
    const float open = open_sky[static_cast<Eigen::Index>(c)], up = below[static_cast<Eigen::Index>(c)];
    const float all = open + up;
    // ambient_light() of the shaders.
    const float albedo = of_meshes[static_cast<Eigen::Index>(c)];
    const auto ambient = [=](float part) {
      const float turned = open * (1.0F - part) / (all + 1e-6F);
      return (open * part + up) / std::max(1.0F - turned * albedo, 0.05F);
    };
    const std::uint16_t* mesh = r.planes + (6 + 3 * static_cast<std::size_t>(r.lights) + c) * r.plane;
    for (std::size_t x = 0; x < count; ++x) {
      const float sent = from_half(diffuse[x]), part = seen[x];
      const float light = ambient(part);
      taken[x] = sent * (all - light) +
                 r.mirrored * (1.0F - part) * (from_half(mirrored[x]) - light * from_half(mesh[x]));
    }
    if (r.lit != nullptr) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(r.lights); ++i) {
        const std::uint16_t* light = r.planes + (6 + 3 * i + c) * r.plane;
        for (std::size_t x = 0; x < count; ++x) taken[x] += hidden[i][x] * from_half(light[x]);
      }
    }
    for (std::size_t x = 0; x < count; ++x)
      r.color[3 * x + c] = std::max(r.color[3 * x + c] - taken[x], 0.0F);
  }
}

/// What the ground's map says at the corners of cells, of which a run has `columns` and a tile's height.
struct SeenCells {
  static constexpr std::size_t rows = tile_size / cell + 1;
  std::size_t columns;
  std::vector<Color> corners;

  SeenCells(const FrameBlock& frame, const GroundSeen& map, const TileRun& run)
      : columns(static_cast<std::size_t>(run.right - run.left) / cell + 1) {
    corners.reserve(columns * rows);
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        const std::optional<GroundPoint> ground = ground_at_pixel(
            frame, run.left + static_cast<float>(cell * i), run.lower + static_cast<float>(cell * j));
        corners.push_back(
            ground ? seen_at(map, frame.ground_map.x() * Vec2(ground->point.x(), ground->point.z()) +
                                      Vec2(frame.ground_map.z(), frame.ground_map.w()))
                   : Color(Color::Ones()));
      }
    }
  }

  /// Of row y of the run, bilinear, a plane a colour.
  void row(int y, std::array<std::vector<float>, 3>& to) const {
    const auto below = static_cast<std::size_t>(y / cell) * columns;
    const float up = (static_cast<float>(y % cell) + 0.5F) / cell;
    for (std::vector<float>& plane : to) plane.resize((columns - 1) * cell);
    const auto corner = [&](std::size_t i) -> Color {
      return (1.0F - up) * corners[below + i] + up * corners[below + columns + i];
    };
    Color left = corner(0);
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const Color right = corner(i + 1), step = (right - left) / cell;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto k = static_cast<Eigen::Index>(c);
        for (std::size_t x = 0; x < cell; ++x)
          to[c][i * cell + x] = left[k] + (static_cast<float>(x) + 0.5F) * step[k];
      }
      left = right;
    }
  }
};

void take_run(const FrameBlock& frame, const StillParts& still, const GroundSeen& map, const TileRun& run,
              const LitPixels& lit, const PixelRectangle& drawn, bool mirrored_by_rays,
              std::span<float> color) {
  const PixelRectangle at = common_rectangle({static_cast<int>(run.left), static_cast<int>(run.lower),
                                              static_cast<int>(run.right - run.left), tile_size},
                                             drawn);
  const SeenCells cells(frame, map, run);
  const Vec4& meshes = frame.mesh_albedo;
  const Color albedo(meshes.x(), meshes.y(), meshes.z());
  std::array<std::vector<float>, 3> seen;
  for (int y = at.y; y < at.y + at.height; ++y) {
    cells.row(y - static_cast<int>(run.lower), seen);
    for (int x = at.x; x < at.x + at.width; x += most_pixels) {
      TakenRow row{};
      row.count = std::min(most_pixels, at.x + at.width - x);
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(still.width) + static_cast<std::size_t>(x);
      row.planes = still.planes.get() + pixel;
      row.plane = still.pixels();
      row.lights = still.lights;
      row.mirrored = mirrored_by_rays ? 0.0F : 1.0F;
      if (run.lights_hidden != 0) {
        row.lit = lit.lights.data() +
                  static_cast<std::size_t>(y - lit.at.y) * static_cast<std::size_t>(lit.at.width) +
                  static_cast<std::size_t>(x - lit.at.x);
      }
      for (std::size_t c = 0; c < 3; ++c) row.seen[c] = seen[c].data() + (x - static_cast<int>(run.left));
      row.color = color.data() + 3 * (static_cast<std::size_t>(still.height - 1 - y) *
                                          static_cast<std::size_t>(still.width) +
                                      static_cast<std::size_t>(x));
      take(row, still.open, still.from_below, albedo);
    }
  }
}

}  // namespace

GroundSeen ground_seen(const LitPixels& lit) {
  const int size = lit.at.width;
  GroundSeen map{size, {}};
  map.texels.reserve(lit.diffuse.size());
  std::vector<float> edge;
  for (int k = 0; k < size; ++k) {
    const float at = (static_cast<float>(k) + 0.5F) / static_cast<float>(size);
    const float t = std::min(10.0F * std::min(at, 1.0F - at), 1.0F);
    edge.push_back(t * t * (3.0F - 2.0F * t));
  }
  for (std::size_t k = 0; k < lit.diffuse.size(); ++k) {
    const Parts& p = lit.diffuse[k];
    const Color part = Color(p[0], p[1], p[2]) / 65535.0F;
    const auto width = static_cast<std::size_t>(size);
    map.texels.emplace_back(1.0F - edge[k % width] * edge[k / width] * (1.0F - part));
  }
  return map;
}

void copy_less_taken(const FrameBlock& frame, const StillParts& still, const GroundSeen& map,
                     std::span<const TileRun> runs, const LitPixels& lit, const PixelRectangle& drawn,
                     bool mirrored_by_rays, std::span<float> color) {
  const int first = drawn.y / tile_size, last = (drawn.y + drawn.height + tile_size - 1) / tile_size;
  const auto width = static_cast<std::size_t>(still.width);
  tbb::parallel_for(first, last, [&](int k) {
    const int end = std::min((k + 1) * tile_size, drawn.y + drawn.height);
    for (int y = std::max(k * tile_size, drawn.y); y < end; ++y) {
      const float* from = still.picture.data() +
                          3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(drawn.x));
      std::copy_n(from, 3 * drawn.width,
                  color.begin() + static_cast<std::ptrdiff_t>(
                                      3 * (static_cast<std::size_t>(still.height - 1 - y) * width +
                                           static_cast<std::size_t>(drawn.x))));
    }
    const auto lower = [](const TileRun& run, float y) { return run.lower < y; };
    for (auto run = std::lower_bound(runs.begin(), runs.end(), static_cast<float>(k * tile_size), lower);
         run != runs.end() && run->lower < static_cast<float>((k + 1) * tile_size); ++run)
      take_run(frame, still, map, *run, lit, drawn, mirrored_by_rays, color);
  });
}

}  // namespace lagomorph::render::raster
