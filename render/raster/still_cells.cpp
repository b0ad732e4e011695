#include "render/raster/still_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include <tbb/parallel_for.h>

#include "render/raster/pixel_ray.h"
#include "render/simd.h"

namespace lagomorph::render::raster {
namespace {

/// Of what the ground sends, that a pixel between corners may differ by: less than a tenth of a step of 8
/// bits.
constexpr float most_bend = 2e-3F;

constexpr std::size_t picture_channels = 3;
constexpr std::size_t side = tile_size;
constexpr std::size_t corners_of_tile = still_cells_of_tile + 1;
using TileRow = std::array<float, side>;

std::size_t place(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// Whether the plane between the corners of a tile is about as flat as its cells.
bool is_smooth(const StillCells& cells, const std::vector<float>& planes, std::size_t first) {
  const auto width = static_cast<std::size_t>(cells.columns);
  for (std::size_t c = 0; c < picture_channels; ++c) {
    const float* plane = planes.data() + c * cells.corners() + first;
    for (std::size_t j = 0; j < corners_of_tile; ++j) {
      for (std::size_t i = 0; i < corners_of_tile; ++i) {
        const float* at = plane + j * width + i;
        // What linear interpolation misses of a parabola.
        float bend = 0.0F;
        if (i > 0 && i + 1 < corners_of_tile) bend += std::abs(at[-1] - 2.0F * at[0] + at[1]);
        if (j > 0 && j + 1 < corners_of_tile) bend += std::abs(*(at - width) - 2.0F * at[0] + at[width]);
        if (!(0.125F * bend <= most_bend * at[0] + 1e-6F)) return false;
      }
    }
  }
  return true;
}

StillTile kind_of_tile(const FrameBlock& frame, const StillCells& cells, int x, int y, bool each_pixel) {
  if (frame.ground.w() < 0.5F) return StillTile::background;
  const std::size_t first = place(x * still_cells_of_tile, y * still_cells_of_tile, cells.columns);
  std::size_t met = 0;
  for (std::size_t j = 0; j < corners_of_tile; ++j) {
    for (std::size_t i = 0; i < corners_of_tile; ++i)
      met += cells.met[first + j * static_cast<std::size_t>(cells.columns) + i] != 0 ? 1 : 0;
  }
  if (met == 0) return StillTile::background;
  if (met < corners_of_tile * corners_of_tile) return StillTile::each_pixel;
  const std::optional<std::array<Vec3, 4>> corners = tile_corners(frame, x * tile_size, y * tile_size).all();
  if (!corners) return StillTile::each_pixel;  // by rounding
  if (distance_from_middle(frame, *corners) > frame.ground.y()) return StillTile::background;
  if (each_pixel) return StillTile::each_pixel;
  for (const std::vector<float>& planes : cells.planes) {
    if (!planes.empty() && !is_smooth(cells, planes, first)) return StillTile::each_pixel;
  }
  const bool fades = std::any_of(corners->begin(), corners->end(), [&](const Vec3& p) {
    return (p - frame.ground_at.head<3>()).norm() > frame.ground.z();
  });
  return fades ? StillTile::fading : StillTile::solid;
}

/// Part of the ground that does not fade, of a row of a tile whose lower left pixel is (x, y).
LAGOMORPH_INLINE void ground_parts(const FrameBlock& frame, float x, float y, TileRow& parts) {
  const float up = 2.0F * (y + 0.5F) * frame.viewport[3] - 1.0F;
  const float moves = frame.eye[3] > 0.5F ? 1.0F : 0.0F;  // of the rays: their origin, or their direction
  const float turns = 1.0F - moves;
  const float start = frame.ground[2], radius = frame.ground[1];
  for (std::size_t k = 0; k < side; ++k) {
    const float right = 2.0F * (x + static_cast<float>(k) + 0.5F) * frame.viewport[2] - 1.0F;
    const float across_x = right * frame.right[0] + up * frame.up[0];
    const float across_y = right * frame.right[1] + up * frame.up[1];
    const float across_z = right * frame.right[2] + up * frame.up[2];
    const float depth =
        (frame.ground[0] - frame.eye[1] - moves * across_y) / (frame.forward[1] + turns * across_y);
    const float at_x = frame.eye[0] + moves * across_x + depth * (frame.forward[0] + turns * across_x);
    const float at_z = frame.eye[2] + moves * across_z + depth * (frame.forward[2] + turns * across_z);
    const float from_x = at_x - frame.ground_at[0], from_z = at_z - frame.ground_at[2];
    parts[k] = 1.0F - fade_at(std::sqrt(from_x * from_x + from_z * from_z), start, radius);
  }
}

/// A row of a tile between the corners of the row of cells that it is in; `up` is how far above the lower of
/// them.
LAGOMORPH_INLINE void interpolate(const float* corners, std::size_t columns, float up, TileRow& row) {
  std::array<float, corners_of_tile> at{};
  for (std::size_t i = 0; i < corners_of_tile; ++i)
    at[i] = corners[i] + up * (corners[columns + i] - corners[i]);
  for (std::size_t i = 0; i < still_cells_of_tile; ++i) {
    const float step = (at[i + 1] - at[i]) * (1.0F / still_cell);
    for (std::size_t k = 0; k < still_cell; ++k)
      row[i * still_cell + k] = at[i] + (static_cast<float>(k) + 0.5F) * step;
  }
}

/// A tile of cells, row by row.
struct CellTile {
  const FrameBlock& frame;
  const StillCells& cells;
  int x, y;  // of its lower left pixel
  bool fades;
  const float* behind;   // backdrop's colour at that pixel; nullptr: the background is one colour
  const float* texture;  // likewise the texture's part; nullptr: there is none
  std::size_t width;     // of the picture
  std::size_t count;     // pixels of a row that are in the picture
};

/// The texture's part in a row, where there is any.
LAGOMORPH_INLINE void texture_parts(const CellTile& t, std::size_t j, TileRow& parts) {
  for (std::size_t k = 0; k < t.count; ++k) parts[k] = t.texture[4 * (j * t.width + k)];
}

/// A channel of row j, of ground that does not fade.
LAGOMORPH_INLINE void channel_row(const CellTile& t, std::size_t channel, std::size_t j,
                                  const TileRow& texture, TileRow& row) {
  const float up = (static_cast<float>(j % still_cell) + 0.5F) * (1.0F / still_cell);
  const auto columns = static_cast<std::size_t>(t.cells.columns);
  const std::size_t first = channel * t.cells.corners() +
                            (static_cast<std::size_t>(t.y) + j) / still_cell * columns +
                            static_cast<std::size_t>(t.x) / still_cell;
  interpolate(t.cells.planes[0].data() + first, columns, up, row);
  if (t.cells.planes[1].empty()) return;
  TileRow other;
  interpolate(t.cells.planes[1].data() + first, columns, up, other);
  for (std::size_t k = 0; k < side; ++k) row[k] += texture[k] * (other[k] - row[k]);
}

/// What fades, and the texture, of row j.
LAGOMORPH_INLINE void weights_of_row(const CellTile& t, std::size_t j, TileRow& parts, TileRow& texture) {
  if (t.fades) {
    ground_parts(t.frame, static_cast<float>(t.x), static_cast<float>(t.y) + static_cast<float>(j), parts);
  } else {
    parts.fill(1.0F);
  }
  texture.fill(0.0F);
  if (t.texture != nullptr) texture_parts(t, j, texture);
}

/// One row of the picture, interleaved.
LAGOMORPH_RENDER_SIMD void fill_picture_row(const CellTile& t, std::size_t j,
                                            const std::array<float, 3>& background, float* picture) {
  alignas(64) TileRow parts, texture, row;
  weights_of_row(t, j, parts, texture);
  for (std::size_t c = 0; c < picture_channels; ++c) {
    channel_row(t, c, j, texture, row);
    if (!t.fades) {
      for (std::size_t k = 0; k < t.count; ++k) picture[3 * k + c] = row[k];
    } else {
      for (std::size_t k = 0; k < t.count; ++k) {
        const float behind = t.behind == nullptr ? background[c] : t.behind[4 * (j * t.width + k) + c];
        picture[3 * k + c] = parts[k] * row[k] + (1.0F - parts[k]) * behind;
      }
    }
  }
}

/// Of a value that is not negative, its half float; 0 below those that are normal, 6e-5.
LAGOMORPH_INLINE std::uint16_t to_half(float x) {
  constexpr std::uint32_t least = 113U << 23U, offset = 112U << 23U;
  const auto bits = std::bit_cast<std::uint32_t>(std::min(x, 65504.0F));
  return static_cast<std::uint16_t>(bits < least ? 0U
                                                 : (bits - offset + 0xfffU + ((bits >> 13U) & 1U)) >> 13U);
}

LAGOMORPH_RENDER_SIMD void fill_planes_row(const CellTile& t, std::size_t j, std::size_t channels,
                                           std::size_t plane, std::uint16_t* to) {
  alignas(64) TileRow parts, texture, row;
  weights_of_row(t, j, parts, texture);
  for (std::size_t c = 0; c < channels; ++c) {
    channel_row(t, picture_channels + c, j, texture, row);
    for (std::size_t k = 0; k < t.count; ++k) to[c * plane + k] = to_half(parts[k] * row[k]);
  }
}

CellTile cell_tile(const FrameBlock& frame, const StillCells& cells, StillTile kind, int x, int y,
                   const Backdrop& backdrop, const StillParts& still) {
  const float* at =
      backdrop.empty() ? nullptr : backdrop.data() + 4 * place(x * tile_size, y * tile_size, still.width);
  CellTile t{frame, cells, x * tile_size, y * tile_size, kind == StillTile::fading, nullptr, nullptr, 0, 0};
  if (at != nullptr && frame.background[3] < 0.5F) t.behind = at;
  if (at != nullptr && !cells.planes[1].empty()) t.texture = at + 3;
  t.width = static_cast<std::size_t>(still.width);
  t.count = static_cast<std::size_t>(std::min(tile_size, still.width - t.x));
  return t;
}

void fill_background(const CellTile& t, std::size_t j, float* picture) {
  for (std::size_t k = 0; k < t.count; ++k) {
    for (std::size_t c = 0; c < picture_channels; ++c) {
      picture[3 * k + c] = t.behind == nullptr ? t.frame.background[static_cast<Eigen::Index>(c)]
                                               : t.behind[4 * (j * t.width + k) + c];
    }
  }
}

}  // namespace

std::vector<StillTile> still_tiles(const FrameBlock& frame, const StillCells& cells, bool each_pixel) {
  const int columns = cells.tile_columns(), rows = cells.tile_rows();
  std::vector<StillTile> kinds(place(0, rows, columns));
  tbb::parallel_for(0, rows, [&](int y) {
    for (int x = 0; x < columns; ++x)
      kinds[place(x, y, columns)] = kind_of_tile(frame, cells, x, y, each_pixel);
  });
  return kinds;
}

void fill_picture(const FrameBlock& frame, const StillCells& cells, std::span<const StillTile> kinds,
                  const Backdrop& backdrop, StillParts& still) {
  const int columns = cells.tile_columns();
  const std::array<float, 3> background = {frame.background[0], frame.background[1], frame.background[2]};
  tbb::parallel_for(0, cells.tile_rows(), [&](int y) {
    for (int x = 0; x < columns; ++x) {
      const StillTile kind = kinds[place(x, y, columns)];
      if (kind == StillTile::each_pixel) continue;
      const CellTile t = cell_tile(frame, cells, kind, x, y, backdrop, still);
      const auto rows = static_cast<std::size_t>(std::min(tile_size, still.height - t.y));
      for (std::size_t j = 0; j < rows; ++j) {
        float* to = still.picture.data() + 3 * (place(t.x, t.y, still.width) + j * t.width);
        kind == StillTile::background ? fill_background(t, j, to) : fill_picture_row(t, j, background, to);
      }
    }
  });
}

void fill_planes(const FrameBlock& frame, const StillCells& cells, StillTile kind, int x, int y,
                 const Backdrop& backdrop, StillParts& still) {
  const CellTile t = cell_tile(frame, cells, kind, x, y, backdrop, still);
  const std::size_t channels = still.plane_count();
  const auto rows = static_cast<std::size_t>(std::min(tile_size, still.height - t.y));
  for (std::size_t j = 0; j < rows; ++j) {
    std::uint16_t* to = still.planes.get() + place(t.x, t.y, still.width) + j * t.width;
    if (kind == StillTile::background) {
      for (std::size_t c = 0; c < channels; ++c)
        std::fill_n(to + c * still.pixels(), t.count, std::uint16_t{0});
    } else {
      fill_planes_row(t, j, channels, still.pixels(), to);
    }
  }
}

}  // namespace lagomorph::render::raster
