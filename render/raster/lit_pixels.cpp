#include "render/raster/lit_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <tbb/parallel_for.h>

#include "render/raster/quad_parts.h"
#include "render/raster/sky_visibility.h"
#include "render/raster/soft_shadow.h"

namespace lagomorph::render::raster {
namespace {

constexpr Parts whole = {65535, 65535, 65535, 65535};
constexpr int quads_width = 2 * block_width, quads_height = 2 * block_height;  // of a block of quads [pixels]

std::uint16_t fraction(float x) {
  return static_cast<std::uint16_t>(std::clamp(x * 65535.0F + 0.5F, 0.0F, 65535.0F));
}

/// Blocks of `part` with a block more to all sides, for neighbours of its points to be there; receivers(x, y,
/// r) puts those of the block at a corner, `step` pixels apart, and says whether anything is there.
template <class BlockReceivers>
ReceiverBlocks receivers_around(const PixelRectangle& part, int step, const BlockReceivers& receivers) {
  ReceiverBlocks all;
  const int width = step * block_width, height = step * block_height;
  all.resize(part.width / width + 2, part.height / height + 2);
  for (int k = 0; k < all.rows * all.columns; ++k) {
    const int x = part.x + (k % all.columns - 1) * width, y = part.y + (k / all.columns - 1) * height;
    const auto i = static_cast<std::size_t>(k);
    all.empty[i] = receivers(x, y, all.blocks[i]) ? 0 : 1;
  }
  return all;
}

/// Calls part() for bands of a rectangle of whole blocks of quads, on all threads.
template <class Part>
void for_bands(int width, int height, const Part& part) {
  constexpr int most = 64;  // rows, over which a block more to both sides is little
  tbb::parallel_for(0, (height + most - 1) / most, [&](int k) {
    part(PixelRectangle{0, k * most, width, std::min(most, height - k * most)});
  });
}

std::size_t pixel_of(const PixelRectangle& at, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(at.width) + static_cast<std::size_t>(x);
}

std::size_t area(const PixelRectangle& r) {
  return static_cast<std::size_t>(r.width) * static_cast<std::size_t>(r.height);
}

void put_sky(const Lanes3& seen, const PixelRectangle& at, int x, int y, std::vector<Parts>& parts) {
  for (int lane = 0; lane < lanes; ++lane) {
    const Vec3 v = seen.at(lane);
    parts[pixel_of(at, x + column(lane), y + row(lane))] = {fraction(v.x()), fraction(v.y()), fraction(v.z()),
                                                            65535};
  }
}

constexpr std::uint32_t all_lights = ~0U;
enum class Sky { left_out, diffuse, mirrored_too };

/// What is asked for of the pixels of a part, and where it goes; rectangles count from `lit.at`.
struct Lighting {
  const FrameBlock& frame;
  const DepthMaps& maps;
  std::uint32_t lights;  // those whose bit is set
  Sky sky;
  LitPixels& lit;

  bool wants(std::size_t light) const { return (lights >> light & 1U) != 0; }
};

/// Calls to(light, seen) for each that is asked for: the parts that soft_shadow() finds.
template <class To>
void for_lights(const Lighting& l, const ReceiverBlocks& receivers, const To& to) {
  std::vector<float> seen;
  for (std::size_t i = 0; i < l.maps.lights.size(); ++i) {
    if (!l.wants(i)) continue;
    soft_shadow(l.frame, l.maps, static_cast<int>(i), receivers, seen);
    to(i, seen);
  }
}

QuadParts parts_of_quads(const Lighting& l, const ReceiverBlocks& quads) {
  QuadParts parts(quads);
  for_lights(l, quads, [&](std::size_t light, const std::vector<float>& seen) {
    std::size_t k = 0;
    for (int y = 0; y < parts.height(); ++y) {
      for (int x = 0; x < parts.width(); ++x) parts.at(x, y)[light] = seen[k++];
    }
  });
  if (l.sky != Sky::left_out) {
    quads.for_each([&](int x, int y, const Receivers& r) {
      SkySeen seen;
      sky_seen(l.frame, l.maps, r, seen);
      for (int lane = 0; lane < lanes; ++lane) {
        SeenParts& p = parts.at(x + column(lane), y + row(lane));
        for (const auto& [first, of] :
             {std::pair{first_sky, &seen.diffuse}, {first_mirrored, &seen.mirrored}}) {
          const Vec3 v = of->at(lane);
          p[first] = v.x(), p[first + 1] = v.y(), p[first + 2] = v.z();
        }
      }
    });
  }
  parts.finish(quads);
  return parts;
}

void put_parts(const Lighting& l, const SeenParts& seen, std::size_t pixel) {
  for (std::size_t i = 0; i < l.maps.lights.size(); ++i) {
    if (l.wants(i)) l.lit.lights[pixel][i] = fraction(seen[i]);
  }
  const auto sky = [&](std::size_t first) {
    return Parts{fraction(seen[first]), fraction(seen[first + 1]), fraction(seen[first + 2]), 65535};
  };
  if (l.sky != Sky::left_out) l.lit.diffuse[pixel] = sky(first_sky);
  if (l.sky == Sky::mirrored_too) l.lit.mirrored[pixel] = sky(first_mirrored);
}

/// Pixel by pixel, of those blocks of the part that are not empty; a block more is around.
void light_each_pixel(const Lighting& l, const PixelRectangle& part, const ReceiverBlocks& receivers) {
  const auto for_inner_blocks = [&](const auto& block) {
    receivers.for_each([&](int x, int y, const Receivers& r) {
      const int px = x - block_width, py = y - block_height;
      if (px >= 0 && py >= 0 && px < part.width && py < part.height) block(x, y, part.x + px, part.y + py, r);
    });
  };
  for_lights(l, receivers, [&](std::size_t light, const std::vector<float>& seen) {
    for_inner_blocks([&](int x, int y, int to_x, int to_y, const Receivers&) {
      for (int j = 0; j < block_height; ++j) {
        const float* from = seen.data() + (y + j) * receivers.width() + x;
        Parts* to = l.lit.lights.data() + pixel_of(l.lit.at, to_x, to_y + j);
        for (int i = 0; i < block_width; ++i) to[i][light] = fraction(from[i]);
      }
    });
  });
  if (l.sky == Sky::left_out) return;
  for_inner_blocks([&](int, int, int to_x, int to_y, const Receivers& r) {
    SkySeen seen;
    sky_seen(l.frame, l.maps, r, seen);
    put_sky(seen.diffuse, l.lit.at, to_x, to_y, l.lit.diffuse);
    if (l.sky == Sky::mirrored_too) put_sky(seen.mirrored, l.lit.at, to_x, to_y, l.lit.mirrored);
  });
}

/// By quads where that will do. receivers(x, y, step, r) are those of a block at pixel (x, y) of the part;
/// shared(x, y, parts, seen) what the quads say of a pixel, false where they say nothing.
template <class BlockReceivers, class Shared>
void light_part(const Lighting& l, const PixelRectangle& part, const BlockReceivers& receivers,
                const Shared& shared) {
  const PixelRectangle own = {0, 0, part.width, part.height};
  const ReceiverBlocks quads =
      receivers_around(own, 2, [&](int x, int y, Receivers& r) { return receivers(x, y, 2, r); });
  const QuadParts parts = parts_of_quads(l, quads);
  const int columns = part.width / block_width;
  std::vector<char> alone(static_cast<std::size_t>(columns * (part.height / block_height)), 0);
  bool any = false;
  SeenParts seen;
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      const auto k = static_cast<std::size_t>(y / block_height * columns + x / block_width);
      if (alone[k] != 0) continue;
      if (shared(x, y, parts, seen)) {
        put_parts(l, seen, pixel_of(l.lit.at, part.x + x, part.y + y));
      } else {
        alone[k] = 1;
        any = true;
      }
    }
  }
  if (!any) return;
  light_each_pixel(
      l, part, receivers_around(own, 1, [&](int x, int y, Receivers& r) {
        const bool inside = x >= 0 && y >= 0 && x < part.width && y < part.height;
        return inside && alone[static_cast<std::size_t>(y / block_height * columns + x / block_width)] != 0 &&
               receivers(x, y, 1, r);
      }));
}

}  // namespace

PixelRectangle whole_blocks(const PixelRectangle& r) {
  const auto down = [](int x, int step) { return x / step * step; };
  const auto up = [](int x, int step) { return (x + step - 1) / step * step; };
  const int x = down(r.x, quads_width), y = down(r.y, quads_height);
  return {x, y, up(r.x + r.width, quads_width) - x, up(r.y + r.height, quads_height) - y};
}

void light_ground(const FrameBlock& frame, const DepthMaps& maps, std::span<const TileRun> runs,
                  LitPixels& lit) {
  int left = 1 << 30, lower = left, right = 0, upper = 0;
  for (const TileRun& run : runs) {
    if (run.lights_hidden == 0) continue;
    left = std::min(left, static_cast<int>(run.left));
    lower = std::min(lower, static_cast<int>(run.lower));
    right = std::max(right, static_cast<int>(run.right));
    upper = std::max(upper, static_cast<int>(run.upper));
  }
  lit.at = right > left ? PixelRectangle{left, lower, right - left, upper - lower} : PixelRectangle{};
  lit.lights.assign(area(lit.at), whole);
  lit.diffuse.clear();
  lit.mirrored.clear();
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
    const TileRun& run = runs[k];
    if (run.lights_hidden == 0) return;
    const int x0 = static_cast<int>(run.left), y0 = static_cast<int>(run.lower);
    const PixelRectangle part{x0 - lit.at.x, y0 - lit.at.y, static_cast<int>(run.right) - x0,
                              static_cast<int>(run.upper) - y0};
    light_part(
        {frame, maps, run.lights_hidden, Sky::left_out, lit}, part,
        [&](int x, int y, int step, Receivers& r) {
          return ground_receivers(frame, x0 + x, y0 + y, step, r);
        },
        [](int x, int y, const QuadParts& quads, SeenParts& seen) {
          return quads.find(x + quads_width, y + quads_height, 0.0F, Vec3::UnitY(), 1.0F, seen);
        });
  });
}

bool light_surfaces(const FrameBlock& frame, const DepthMaps& maps, const PixelRectangle& rectangle,
                    std::span<const SurfaceTexel> texels, LitPixels& lit) {
  if (std::all_of(texels.begin(), texels.end(), [](const SurfaceTexel& t) { return t.depth == 0; }))
    return false;
  lit.at = rectangle;
  for (std::vector<Parts>* parts : {&lit.lights, &lit.diffuse}) parts->resize(area(rectangle));
  lit.mirrored.resize(maps.sky_is_map ? area(rectangle) : 0);
  const SurfaceTexels surfaces{rectangle, texels};
  for_bands(rectangle.width, rectangle.height, [&](const PixelRectangle& band) {
    light_part(
        {frame, maps, all_lights, maps.sky_is_map ? Sky::mirrored_too : Sky::diffuse, lit}, band,
        [&](int x, int y, int step, Receivers& r) {
          return surface_receivers(frame, maps.sky_is_map, surfaces, band.x + x, band.y + y, step, r);
        },
        [&](int x, int y, const QuadParts& quads, SeenParts& seen) {
          const SurfaceTexel* t = surfaces.find(band.x + x, band.y + y);
          if (t == nullptr) return true;
          const auto depth = std::bit_cast<float>(t->depth);
          return quads.find(x + quads_width, y + quads_height, depth, normal_of(*t),
                            10.0F * pixel_footprint(frame, depth), seen);
        });
  });
  return true;
}

void light_ground_map(const FrameBlock& frame, const DepthMaps& maps, LitPixels& lit) {
  const int size = static_cast<int>(frame.counts[3]);
  lit.at = {0, 0, size, size};
  lit.lights.assign(area(lit.at), whole);
  lit.diffuse.resize(area(lit.at));
  lit.mirrored.clear();
  const Lighting lighting{frame, maps, all_lights, Sky::left_out, lit};
  for_bands(size, size, [&](const PixelRectangle& band) {
    const ReceiverBlocks receivers = receivers_around(
        band, 1, [&](int x, int y, Receivers& r) { return ground_map_receivers(frame, x, y, r); });
    light_each_pixel(lighting, band, receivers);
    receivers.for_each([&](int x, int y, const Receivers& r) {
      const int px = x - block_width, py = y - block_height;
      if (px < 0 || py < 0 || px >= band.width || py >= band.height) return;
      SkySeen seen;
      sky_seen_softly(frame, maps, r, seen);
      put_sky(seen.diffuse, lit.at, band.x + px, band.y + py, lit.diffuse);
    });
  });
}

}  // namespace lagomorph::render::raster
