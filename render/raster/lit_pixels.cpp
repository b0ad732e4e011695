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
// Of cells [pixels].
constexpr int ground_step = 4, surface_step = 2, sky_step = 4, bounce_step = 2;

int down(int x, int step) { return x / step * step; }
int up(int x, int step) { return down(x + step - 1, step); }

std::uint16_t fraction(float x) {
  return static_cast<std::uint16_t>(std::clamp(x * 65535.0F + 0.5F, 0.0F, 65535.0F));
}

constexpr int side_wanted = 8;  // [pixels]
static_assert(tile_size % side_wanted == 0 && (2 * sky_step) % side_wanted == 0);
constexpr auto everywhere = [](int, int) { return true; };

/// What cells say of a pixel.
enum class Found { nothing_there, yes, no };

constexpr int band_height = 64;  // rows, over which cells more to both sides are few

/// Calls part() for bands of a rectangle of whole_cells(), counted from its corner, on all threads.
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

/// What is asked for of the pixels of a part, and where it goes; rectangles count from `lit.at`.
struct Lighting {
  const FrameBlock& frame;
  const DepthMaps& maps;
  LitPixels& lit;
};

/// Of each block, N parts of its receivers, and which of these see edges that are hard (Shadow).
template <std::size_t N>
struct BlockParts {
  std::vector<std::array<Lanes, N>> seen;
  std::vector<LaneBits> hard;
};

/// What is seen of each light.
struct OfLights {
  static constexpr std::size_t count = most_lights;
  static constexpr int quads_beside = 1;  // neighbours share
  Lighting to;
  Smoothness smooth = {0.1F, true};

  BlockParts<count> find(const ReceiverBlocks& at) const {
    Lanes all;
    all.fill(1.0F);
    std::array<Lanes, count> of_all;
    of_all.fill(all);  // of lights that are not there, too
    BlockParts<count> parts{std::vector<std::array<Lanes, count>>(at.blocks.size(), of_all),
                            std::vector<LaneBits>(at.blocks.size())};
    std::vector<Lanes> seen;
    for (std::size_t i = 0; i < to.maps.lights.size(); ++i) {
      soft_shadow(to.frame, to.maps, static_cast<int>(i), at, seen, parts.hard);
      for (std::size_t b = 0; b < seen.size(); ++b) parts.seen[b][i] = seen[b];
    }
    return parts;
  }
  void put(const std::array<float, count>& seen, std::size_t pixel) const {
    for (std::size_t i = 0; i < to.maps.lights.size(); ++i) to.lit.lights[pixel][i] = fraction(seen[i]);
  }
};

enum class SkyLit { diffuse, mirrored_too, softly };

/// What is seen of the sky.
template <SkyLit lit>
struct OfSky {
  static constexpr std::size_t count = lit == SkyLit::mirrored_too ? 7 : 4;
  static constexpr int quads_beside = 0;
  Lighting to;
  Smoothness smooth = {0.1F, false};

  BlockParts<count> find(const ReceiverBlocks& at) const {
    BlockParts<count> parts{std::vector<std::array<Lanes, count>>(at.blocks.size()),
                            std::vector<LaneBits>(at.blocks.size())};
    SkySeen seen;
    for (std::size_t b = 0; b < at.blocks.size(); ++b) {
      const Receivers& r = at.blocks[b].at;
      lit == SkyLit::softly ? sky_seen_softly(to.frame, to.maps, r, seen)
                            : sky_seen(to.frame, to.maps, r, seen);
      std::array<Lanes, count>& of = parts.seen[b];
      of[0] = seen.diffuse.x, of[1] = seen.diffuse.y, of[2] = seen.diffuse.z, of[3] = seen.below;
      if constexpr (lit == SkyLit::mirrored_too)
        of[4] = seen.mirrored.x, of[5] = seen.mirrored.y, of[6] = seen.mirrored.z;
    }
    return parts;
  }
  void put(const std::array<float, count>& seen, std::size_t pixel) const {
    to.lit.diffuse[pixel] = {fraction(seen[0]), fraction(seen[1]), fraction(seen[2]), fraction(seen[3])};
    if constexpr (lit == SkyLit::mirrored_too)
      to.lit.mirrored[pixel] = {fraction(seen[4]), fraction(seen[5]), fraction(seen[6]), 0};
  }
};

/// Calls to(x, y, parts) with those of every receiver.
template <std::size_t N, class To>
void for_receivers(const ReceiverBlocks& at, const BlockParts<N>& parts, const To& to) {
  for (std::size_t b = 0; b < at.blocks.size(); ++b) {
    at.blocks[b].for_lanes([&](std::size_t lane, int x, int y) {
      std::array<float, N> seen;
      for (std::size_t k = 0; k < N; ++k) seen[k] = parts.seen[b][k][lane];
      to(x, y, seen);
    });
  }
}

/// By cells of step x step pixels where that will do, else pixel by pixel; sides of the part are whole quads
/// of cells. receivers(x, y, step, first lane, r) are those of the quad at pixel (x, y) of the part;
/// wanted(x, y) whether any is in the `side_wanted` pixels from there on; shared(x, y, cells, at_x, at_y,
/// seen) what the cells, from whose own corner the pixel is at (at_x, at_y), say of it.
template <int step, class What, class QuadReceivers, class Wanted, class Shared>
void light_part(const What& what, const PixelRectangle& part, const QuadReceivers& receivers,
                const Wanted& wanted, const Shared& shared) {
  constexpr std::size_t count = What::count;
  constexpr int before = 2 * What::quads_beside;  // cells, and two after them
  ReceiverBlocks cells{part.width / step + before + 2, part.height / step + before + 2, step, {}};
  for (int y = 0; y < cells.height; y += 2) {
    for (int x = 0; x < cells.width; x += 2) {
      cells.add(x, y, [&](int lane, Receivers& r) {
        return receivers((x - before) * step, (y - before) * step, step, lane, r);
      });
    }
  }
  CoarseParts<count, step> parts(cells);
  const BlockParts<count> found_of_cells = what.find(cells);
  for_receivers<count>(cells, found_of_cells,
                       [&](int x, int y, const std::array<float, count>& seen) { parts.at(x, y) = seen; });
  parts.finish(cells, what.smooth, found_of_cells.hard);
  const auto pixel = [&](int x, int y) { return pixel_of(what.to.lit.at, part.x + x, part.y + y); };
  ReceiverBlocks alone{part.width, part.height, 1, {}};
  std::array<float, count> seen;
  for (int y = 0; y < part.height; y += 2) {
    for (int x = 0; x < part.width; x += 2) {
      if (x % side_wanted == 0 && !wanted(x, y)) {
        x += side_wanted - 2;
        continue;
      }
      bool all_found = true;
      for (int i = 0; i < quad && all_found; ++i) {
        const int px = x + (i & 1), py = y + row(i);
        const Found found = shared(px, py, parts, px + before * step, py + before * step, seen);
        if (found == Found::yes) what.put(seen, pixel(px, py));
        all_found = found != Found::no;
      }
      if (!all_found) alone.add(x, y, [&](int lane, Receivers& r) { return receivers(x, y, 1, lane, r); });
    }
  }
  if (alone.empty()) return;
  for_receivers<count>(alone, what.find(alone), [&](int x, int y, const std::array<float, count>& of_pixel) {
    what.put(of_pixel, pixel(x, y));
  });
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
    left = down(left, 2 * ground_step);  // cells' quads are the picture's
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
    if (x + width <= 0 || y + height <= 0) return false;
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

PixelRectangle whole_cells(const PixelRectangle& r) {
  constexpr int side = 2 * sky_step;
  const int x = down(r.x, side), y = down(r.y, side);
  return {x, y, up(r.x + r.width, side) - x, up(r.y + r.height, side) - y};
}

PixelRectangle with_neighbours(const PixelRectangle& r) {
  // Bands, and the cells beside them; to the sides those that decide how a pixel's neighbours are lit.
  constexpr int beside = 8 * ground_step;
  const int x = down(r.x, beside) - beside, y = down(r.y, band_height) - beside;
  return {x, y, up(r.x + r.width, beside) + beside - x, up(r.y + r.height, band_height) + beside - y};
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
    const auto receivers = [&](int x, int y, int apart, int lane, Receivers& r) {
      // Cells beside the tiles, too, or those within would not know that all is seen there.
      const int side = 2 * apart, beside = apart > 1 ? side : 0;
      return tiles.touch(x - beside, band.y + y - beside, side + 2 * beside, side + 2 * beside) &&
             ground_receivers(frame, lit.at.x + x, lit.at.y + band.y + y, apart, lane, r);
    };
    const auto wanted = [&](int x, int y) { return tiles.touch(x, band.y + y, side_wanted, 2); };
    const auto shared = [&](int, int, const auto& cells, int at_x, int at_y, auto& seen) {
      if (cells.is_open(at_x, at_y)) return Found::nothing_there;
      return cells.find(
                 at_x, at_y, 0.0F, [&] { return normal; }, 1.0F, seen)
                 ? Found::yes
                 : Found::no;
    };
    light_part<ground_step>(OfLights{{frame, maps, lit}}, band, receivers, wanted, shared);
  });
}

namespace {

template <int step, class What>
void light_surfaces_by_cells(const What& what, const SurfaceTexels& surfaces) {
  const FrameBlock& frame = what.to.frame;
  for_bands(surfaces.at, [&](const PixelRectangle& band) {
    const auto receivers = [&](int x, int y, int apart, int lane, Receivers& r) {
      return surface_receivers(frame, surfaces, band.x + x, band.y + y, apart, lane, r);
    };
    const auto shared = [&](int x, int y, const auto& cells, int at_x, int at_y, auto& seen) {
      const SurfaceTexel* t = surfaces.find(band.x + x, band.y + y);
      if (t == nullptr) return Found::nothing_there;
      const auto depth = std::bit_cast<float>(t->depth);
      return cells.find(
                 at_x, at_y, depth, [t] { return normal_of(*t); },
                 one_surface * pixel_footprint(frame, depth), seen)
                 ? Found::yes
                 : Found::no;
    };
    light_part<step>(what, band, receivers, everywhere, shared);
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
  const Lighting to{frame, maps, lit};
  light_surfaces_by_cells<surface_step>(OfLights{to}, surfaces);
  if (maps.sky_is_map) {
    light_surfaces_by_cells<sky_step>(OfSky<SkyLit::mirrored_too>{to}, surfaces);
  } else {
    light_surfaces_by_cells<sky_step>(OfSky<SkyLit::diffuse>{to}, surfaces);
  }
  return true;
}

void light_ground_map(const FrameBlock& frame, const DepthMaps& maps, LitPixels& lit) {
  const int size = static_cast<int>(frame.counts[3]);
  lit.at = {0, 0, size, size};
  lit.lights.assign(area(lit.at), whole);
  lit.diffuse.resize(area(lit.at));
  lit.mirrored.clear();
  for_bands(lit.at, [&](const PixelRectangle& band) {
    const auto receivers = [&](int x, int y, int apart, int lane, Receivers& r) {
      return ground_map_receivers(frame, band.x + x, band.y + y, apart, lane, r);
    };
    const auto shared = [](int, int, const auto& cells, int at_x, int at_y, auto& seen) {
      return cells.find(
                 at_x, at_y, 0.0F, [] { return Vec3(Vec3::UnitY()); }, 1.0F, seen)
                 ? Found::yes
                 : Found::no;
    };
    // The map of what bodies see of the ground's light has a texel a cell.
    constexpr Smoothness however = {1.0F, false};
    const Lighting to{frame, maps, lit};
    light_part<bounce_step>(OfLights{to, however}, band, receivers, everywhere, shared);
    light_part<ground_step>(OfSky<SkyLit::softly>{to}, band, receivers, everywhere, shared);
  });
}

}  // namespace lagomorph::render::raster
