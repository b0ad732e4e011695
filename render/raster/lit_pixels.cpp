#include "render/raster/lit_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <tbb/parallel_for.h>

#include "render/raster/coarse_parts.h"
#include "render/raster/pixel_ray.h"
#include "render/raster/sky_visibility.h"
#include "render/raster/soft_shadow.h"

namespace lagomorph::render::raster {
namespace {

constexpr Parts whole = {65535, 65535, 65535, 65535};
constexpr int ground_step = 4, surface_step = 2;  // of their cells [pixels]

int down(int x, int step) { return x / step * step; }
int up(int x, int step) { return down(x + step - 1, step); }

std::uint16_t fraction(float x) {
  return static_cast<std::uint16_t>(std::clamp(x * 65535.0F + 0.5F, 0.0F, 65535.0F));
}

/// Blocks of `part` with a block more to all sides, for neighbours of its points to be there; receivers(x, y,
/// r) puts those of the block at a corner, `step` pixels apart, and says whether anything is there.
template <class BlockReceivers>
ReceiverBlocks receivers_around(const PixelRectangle& part, int step, const BlockReceivers& receivers) {
  ReceiverBlocks all;
  all.step = step;
  const int width = step * block_width, height = step * block_height;
  all.resize(part.width / width + 2, part.height / height + 2);
  for (int k = 0; k < all.rows * all.columns; ++k) {
    const int x = part.x + (k % all.columns - 1) * width, y = part.y + (k / all.columns - 1) * height;
    const auto i = static_cast<std::size_t>(k);
    all.empty[i] = receivers(x, y, all.blocks[i]) ? 0 : 1;
  }
  return all;
}

constexpr auto everywhere = [](int, int) { return true; };

/// What cells say of a pixel.
enum class Found { nothing_there, yes, no };

constexpr int band_height = 64;  // rows, over which a block more to both sides is little

/// Calls part() for bands of a rectangle of whole blocks of cells, counted from its corner, on all threads.
/// They are the same rows of the picture whatever of it is asked for: what is shared ends with them.
template <class Part>
void for_bands(const PixelRectangle& at, const Part& part) {
  const int first = at.y / band_height, end = (at.y + at.height + band_height - 1) / band_height;
  tbb::parallel_for(first, end, [&](int k) {
    const int low = std::max(k * band_height, at.y), high = std::min((k + 1) * band_height, at.y + at.height);
    part(PixelRectangle{0, low - at.y, at.width, high - low});
  });
}

std::size_t pixel_of(const PixelRectangle& at, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(at.width) + static_cast<std::size_t>(x);
}

std::size_t area(const PixelRectangle& r) {
  return static_cast<std::size_t>(r.width) * static_cast<std::size_t>(r.height);
}

void put_sky(const Lanes3& seen, const Lanes& below, const PixelRectangle& at, int x, int y,
             std::vector<Parts>& parts) {
  for (int lane = 0; lane < lanes; ++lane) {
    const Vec3 v = seen.at(lane);
    parts[pixel_of(at, x + column(lane), y + row(lane))] = {fraction(v.x()), fraction(v.y()), fraction(v.z()),
                                                            fraction(below[static_cast<std::size_t>(lane)])};
  }
}

enum class SkyLit { left_out, diffuse, mirrored_too, softly };

/// What is asked for of the pixels of a part, and where it goes; rectangles count from `lit.at`.
struct Lighting {
  const FrameBlock& frame;
  const DepthMaps& maps;
  SkyLit sky;
  LitPixels& lit;
};

void find_sky(const Lighting& l, const Receivers& receivers, SkySeen& seen) {
  l.sky == SkyLit::softly ? sky_seen_softly(l.frame, l.maps, receivers, seen)
                          : sky_seen(l.frame, l.maps, receivers, seen);
}

/// Calls to(light, seen) for each: the parts that soft_shadow() finds.
template <class To>
void for_lights(const Lighting& l, const ReceiverBlocks& receivers, const To& to) {
  std::vector<float> seen;
  for (std::size_t i = 0; i < l.maps.lights.size(); ++i) {
    soft_shadow(l.frame, l.maps, static_cast<int>(i), receivers, seen);
    to(i, seen);
  }
}

constexpr std::size_t first_sky = most_lights, first_mirrored = first_sky + 4;

template <std::size_t N>
CoarseParts<N> parts_of_cells(const Lighting& l, const ReceiverBlocks& cells, int step) {
  CoarseParts<N> parts(cells, step);
  for_lights(l, cells, [&](std::size_t light, const std::vector<float>& seen) {
    std::size_t k = 0;
    for (int y = 0; y < parts.height(); ++y) {
      for (int x = 0; x < parts.width(); ++x) parts.at(x, y)[light] = seen[k++];
    }
  });
  if constexpr (N > first_sky) {
    cells.for_each([&](int x, int y, const Receivers& r) {
      if (y < block_height) return;  // nobody's neighbour to the right or above
      SkySeen seen;
      find_sky(l, r, seen);
      const auto put = [&](std::size_t first, const Lanes3& of) {
        for (int lane = 0; lane < lanes; ++lane) {
          const Vec3 v = of.at(lane);
          float* to = parts.at(x + column(lane), y + row(lane)).data() + first;
          to[0] = v.x(), to[1] = v.y(), to[2] = v.z(), to[3] = seen.below[static_cast<std::size_t>(lane)];
        }
      };
      put(first_sky, seen.diffuse);
      if constexpr (N > first_mirrored) put(first_mirrored, seen.mirrored);
    });
  }
  parts.finish(cells);
  return parts;
}

template <std::size_t N>
void put_parts(const std::array<float, N>& seen, std::size_t pixel, LitPixels& lit) {
  for (std::size_t i = 0; i < most_lights; ++i) lit.lights[pixel][i] = fraction(seen[i]);
  const auto sky = [&](std::size_t first) -> Parts {
    return {fraction(seen[first]), fraction(seen[first + 1]), fraction(seen[first + 2]),
            fraction(seen[first + 3])};
  };
  if constexpr (N > first_sky) lit.diffuse[pixel] = sky(first_sky);
  if constexpr (N > first_mirrored) lit.mirrored[pixel] = sky(first_mirrored);
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
  if (l.sky == SkyLit::left_out) return;
  for_inner_blocks([&](int, int, int to_x, int to_y, const Receivers& r) {
    SkySeen seen;
    find_sky(l, r, seen);
    put_sky(seen.diffuse, seen.below, l.lit.at, to_x, to_y, l.lit.diffuse);
    if (l.sky == SkyLit::mirrored_too)
      put_sky(seen.mirrored, seen.below, l.lit.at, to_x, to_y, l.lit.mirrored);
  });
}

/// By cells of step x step pixels where that will do. receivers(x, y, step, r) are those of a block at pixel
/// (x, y) of the part; wanted(x, y) whether any is in a row of a block from there on; shared(x, y, cells,
/// at_x, at_y, seen) what the cells, from whose own corner the pixel is at (at_x, at_y), say of it.
template <std::size_t N, class BlockReceivers, class Wanted, class Shared>
void light_part(const Lighting& l, const PixelRectangle& part, int step, const BlockReceivers& receivers,
                const Wanted& wanted, const Shared& shared) {
  const PixelRectangle own = {0, 0, part.width, part.height};
  const ReceiverBlocks cells =
      receivers_around(own, step, [&](int x, int y, Receivers& r) { return receivers(x, y, step, r); });
  const CoarseParts<N> parts = parts_of_cells<N>(l, cells, step);
  // The cells' border.
  const int right = step * block_width, above = step * block_height;
  const int columns = part.width / block_width, rows = part.height / block_height;
  std::vector<char> alone(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  const auto block_of = [columns](int x, int y) {
    const int block = y / block_height * columns + x / block_width;
    return static_cast<std::size_t>(block);
  };
  bool any = false;
  std::array<float, N> seen;
  for (int y = 0; y < part.height; ++y) {
    for (int left = 0; left < part.width; left += block_width) {
      const std::size_t k = block_of(left, y);
      if (alone[k] != 0 || !wanted(left, y)) continue;
      for (int x = left; x < left + block_width && alone[k] == 0; ++x) {
        switch (shared(x, y, parts, x + right, y + above, seen)) {
          case Found::nothing_there:
            break;
          case Found::yes:
            put_parts(seen, pixel_of(l.lit.at, part.x + x, part.y + y), l.lit);
            break;
          case Found::no:
            alone[k] = 1, any = true;
            break;
        }
      }
    }
  }
  if (!any) return;
  light_each_pixel(l, part, receivers_around(own, 1, [&](int x, int y, Receivers& r) {
                     const bool inside = x >= 0 && y >= 0 && x < part.width && y < part.height;
                     return inside && alone[block_of(x, y)] != 0 && receivers(x, y, 1, r);
                   }));
}

/// Of tiles, those that are in runs in which lights may be hidden.
class HiddenTiles {
public:
  HiddenTiles(std::span<const TileRun> runs) {
    int left = 1 << 30, lower = left, right = 0, upper = 0;
    for (const TileRun& run : runs) {
      if (run.lights_hidden == 0) continue;
      left = std::min(left, static_cast<int>(run.left));
      lower = std::min(lower, static_cast<int>(run.lower));
      right = std::max(right, static_cast<int>(run.right));
      upper = std::max(upper, static_cast<int>(run.upper));
    }
    if (right <= left) return;
    left = down(left, ground_step * block_width);  // cells' blocks are the picture's
    around_ = {left, lower, right - left, upper - lower};
    columns_ = around_.width / tile_size;
    rows_ = around_.height / tile_size;
    hidden_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    for (const TileRun& run : runs) {
      if (run.lights_hidden == 0) continue;
      const int row = (static_cast<int>(run.lower) - lower) / tile_size;
      for (int x = static_cast<int>(run.left) - left; x < static_cast<int>(run.right) - left; x += tile_size)
        hidden_[place(x / tile_size, row)] = 1;
    }
  }
  const PixelRectangle& around() const { return around_; }
  /// Whether any of the tiles that a rectangle, from around()'s corner, touches is one.
  bool touch(int x, int y, int width, int height) const {
    const int first = std::max(x, 0) / tile_size, last = std::min((x + width - 1) / tile_size, columns_ - 1);
    const int low = std::max(y, 0) / tile_size;
    const int high = std::min((y + height - 1) / tile_size, rows_ - 1);
    for (int j = low; j <= high; ++j) {
      for (int i = first; i <= last; ++i) {
        if (hidden_[place(i, j)] != 0) return true;
      }
    }
    return false;
  }

private:
  std::size_t place(int i, int j) const {
    const int tile = j * columns_ + i;
    return static_cast<std::size_t>(tile);
  }

  PixelRectangle around_;
  int columns_ = 0, rows_ = 0;
  std::vector<char> hidden_;
};

}  // namespace

PixelRectangle whole_blocks(const PixelRectangle& r) {
  constexpr int width = surface_step * block_width, height = surface_step * block_height;
  const int x = down(r.x, width), y = down(r.y, height);
  return {x, y, up(r.x + r.width, width) - x, up(r.y + r.height, height) - y};
}

PixelRectangle with_neighbours(const PixelRectangle& r) {
  // Bands, and the block beside them; to the sides the blocks around that of a pixel.
  constexpr int width = ground_step * block_width, above = 2 * ground_step * block_height;
  const int x = down(r.x, width) - width, y = down(r.y, band_height) - above;
  return {x, y, up(r.x + r.width, width) + width - x, up(r.y + r.height, band_height) + above - y};
}

void light_ground(const FrameBlock& frame, const DepthMaps& maps, std::span<const TileRun> runs,
                  LitPixels& lit) {
  const HiddenTiles tiles(runs);
  lit.at = tiles.around();
  lit.lights.assign(area(lit.at), whole);
  lit.diffuse.clear();
  lit.mirrored.clear();
  const Vec3 normal = ground_is_below(frame) ? Vec3::UnitY() : Vec3(-Vec3::UnitY());
  for_bands(lit.at, [&](const PixelRectangle& band) {
    const auto receivers = [&](int x, int y, int step, Receivers& r) {
      return tiles.touch(x, band.y + y, step * block_width, step * block_height) &&
             ground_receivers(frame, lit.at.x + x, lit.at.y + band.y + y, step, r);
    };
    const auto wanted = [&](int x, int y) { return tiles.touch(x, band.y + y, block_width, 1); };
    const auto shared = [&](int, int, const CoarseParts<most_lights>& cells, int at_x, int at_y,
                            std::array<float, most_lights>& seen) {
      if (cells.is_open(at_x, at_y)) return Found::nothing_there;
      return cells.find(at_x, at_y, 0.0F, normal, 1.0F, seen) ? Found::yes : Found::no;
    };
    light_part<most_lights>({frame, maps, SkyLit::left_out, lit}, band, ground_step, receivers, wanted,
                            shared);
  });
}

namespace {

/// N: parts, see CoarseParts.
template <std::size_t N>
void light_surfaces_by_cells(const Lighting& l, const SurfaceTexels& surfaces) {
  for_bands(surfaces.at, [&](const PixelRectangle& band) {
    const auto receivers = [&](int x, int y, int step, Receivers& r) {
      return surface_receivers(l.frame, surfaces, band.x + x, band.y + y, step, r);
    };
    const auto shared = [&](int x, int y, const CoarseParts<N>& cells, int at_x, int at_y,
                            std::array<float, N>& seen) {
      const SurfaceTexel* t = surfaces.find(band.x + x, band.y + y);
      if (t == nullptr) return Found::nothing_there;
      const auto depth = std::bit_cast<float>(t->depth);
      return cells.find(at_x, at_y, depth, normal_of(*t), 10.0F * pixel_footprint(l.frame, depth), seen)
                 ? Found::yes
                 : Found::no;
    };
    light_part<N>(l, band, surface_step, receivers, everywhere, shared);
  });
}

}  // namespace

bool light_surfaces(const FrameBlock& frame, const DepthMaps& maps, const PixelRectangle& rectangle,
                    std::span<const SurfaceTexel> texels, LitPixels& lit) {
  if (std::none_of(texels.begin(), texels.end(), [](const SurfaceTexel& t) { return t.depth != 0; }))
    return false;
  lit.at = rectangle;
  for (std::vector<Parts>* parts : {&lit.lights, &lit.diffuse}) parts->resize(area(rectangle));
  lit.mirrored.resize(maps.sky_is_map ? area(rectangle) : 0);
  const SurfaceTexels surfaces{rectangle, texels};
  const Lighting lighting{frame, maps, maps.sky_is_map ? SkyLit::mirrored_too : SkyLit::diffuse, lit};
  if (maps.sky_is_map) {
    light_surfaces_by_cells<first_mirrored + 4>(lighting, surfaces);
  } else {
    light_surfaces_by_cells<first_sky + 4>(lighting, surfaces);
  }
  return true;
}

void light_ground_map(const FrameBlock& frame, const DepthMaps& maps, LitPixels& lit) {
  const int size = static_cast<int>(frame.counts[3]);
  lit.at = {0, 0, size, size};
  lit.lights.assign(area(lit.at), whole);
  lit.diffuse.resize(area(lit.at));
  lit.mirrored.clear();
  constexpr std::size_t parts = first_sky + 4;
  for_bands(lit.at, [&](const PixelRectangle& band) {
    const auto receivers = [&](int x, int y, int step, Receivers& r) {
      return ground_map_receivers(frame, band.x + x, band.y + y, step, r);
    };
    const auto shared = [](int, int, const CoarseParts<parts>& cells, int at_x, int at_y,
                           std::array<float, parts>& seen) {
      return cells.find(at_x, at_y, 0.0F, Vec3::UnitY(), 1.0F, seen) ? Found::yes : Found::no;
    };
    light_part<parts>({frame, maps, SkyLit::softly, lit}, band, surface_step, receivers, everywhere, shared);
  });
}

}  // namespace lagomorph::render::raster
