#include "render/image_compare/flip_tile.h"

#include <algorithm>
#include <array>
#include <utility>

#include "render/image_compare/flip_rows.h"
#include "render/image_compare/row_filters.h"

namespace lagomorph::render {

const FlipConstants& flip_constants() {
  static const FlipConstants constants = [] {
    FlipConstants k{};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        k.xyz[r][c] = static_cast<float>(flip::relative_xyz_from_rgb()[r][c]);
        k.rgb[r][c] = static_cast<float>(flip::rgb_from_relative_xyz()[r][c]);
      }
    }
    const double largest = flip::largest_color_distance();
    const double knee = flip::knee_in * largest;
    k.knee = static_cast<float>(knee);
    k.below = static_cast<float>(flip::knee_out / knee);
    k.above = static_cast<float>((1 - flip::knee_out) / (largest - knee));
    return k;
  }();
  return constants;
}

namespace {

/// Where things stand in a tile's memory.
struct Layout {
  Layout(const Tile& tile, std::size_t halo_pixels)
      : halo(halo_pixels),
        source_rows(static_cast<std::size_t>(tile.height) + 2 * halo),
        row(whole_blocks(static_cast<std::size_t>(tile.width))),
        stride(whole_blocks(row + 2 * halo)),
        plane(source_rows * stride) {}
  std::size_t halo;
  std::size_t source_rows;
  std::size_t row;     // of a result
  std::size_t stride;  // of a source row: a halo, the tile's row, a halo
  std::size_t plane;
};

/// A picture's opponent colours in a tile and its halo.
struct Planes {
  float *y, *cx, *cz;
};

/// A row after the vertical filters, halo included.
struct Column {
  float *y, *cx, *cz_1, *cz_2, *gauss, *first, *second;
};

/// A row after both; then what the picture's pixels look like, in l_y, a_cx, b_cz, edge_x and point_x.
struct Row {
  float *l_y, *a_cx, *b_cz, *cz_2, *edge_x, *edge_y, *point_x, *point_y;
  FlipLook look() const { return {l_y, a_cx, b_cz, edge_x, point_x}; }
};

struct Work {
  const FlipFilters& filters;
  Layout at;
  std::array<Planes, 2> planes;
  Column column;
  std::array<Row, 2> row;
};

template <std::size_t n>
LAGOMORPH_INLINE void vertical(const Work& work, const Planes& planes, std::size_t y) {
  const auto step = static_cast<std::ptrdiff_t>(work.at.stride);
  const std::size_t start = (y + work.at.halo) * work.at.stride;
  const FlipFilters& f = work.filters;
  const Column& out = work.column;
  for (std::size_t x = 0; x < work.at.stride; x += block<n>) {
    const float* luminance = planes.y + start + x;
    even<n>(luminance, step, f.y, out.y + x);
    even<n>(luminance, step, f.gauss, out.gauss + x);
    derivatives<n>(luminance, step, f, out.first + x, out.second + x);
    even<n>(planes.cx + start + x, step, f.cx, out.cx + x);
    even<n>(planes.cz + start + x, step, f.cz_1, out.cz_1 + x);
    even<n>(planes.cz + start + x, step, f.cz_2, out.cz_2 + x);
  }
}

template <std::size_t n>
LAGOMORPH_INLINE void horizontal(const Work& work, const Row& out) {
  const FlipFilters& f = work.filters;
  const Column& in = work.column;
  for (std::size_t x = 0; x < work.at.row; x += block<n>) {
    const std::size_t at = work.at.halo + x;
    even<n>(in.y + at, 1, f.y, out.l_y + x);
    even<n>(in.cx + at, 1, f.cx, out.a_cx + x);
    even<n>(in.cz_1 + at, 1, f.cz_1, out.b_cz + x);
    even<n>(in.cz_2 + at, 1, f.cz_2, out.cz_2 + x);
    derivatives<n>(in.gauss + at, 1, f, out.edge_x + x, out.point_x + x);
    even<n>(in.first + at, 1, f.gauss, out.edge_y + x);
    even<n>(in.second + at, 1, f.gauss, out.point_y + x);
  }
}

template <std::size_t n>
LAGOMORPH_INLINE void tile_body(const Work& work, const Tile& tile, float* out, std::size_t out_stride) {
  const FlipConstants& constants = flip_constants();
  for (const Planes& p : work.planes) opponent_row(constants, p.y, p.cx, p.cz, work.at.plane);
  for (std::size_t y = 0; y < static_cast<std::size_t>(tile.height); ++y) {
    for (std::size_t which = 0; which < 2; ++which) {
      const Row& row = work.row[which];
      vertical<n>(work, work.planes[which], y);
      horizontal<n>(work, row);
      lab_row(constants, row.l_y, row.a_cx, row.b_cz, row.cz_2, work.at.row);
      length_row(row.edge_x, row.edge_y, work.at.row);
      length_row(row.point_x, row.point_y, work.at.row);
    }
    flip_row(constants, work.row[0].look(), work.row[1].look(), out + y * out_stride,
             static_cast<std::size_t>(tile.width));
  }
}

void tile_base(const Work& work, const Tile& tile, float* out, std::size_t out_stride) {
  tile_body<4>(work, tile, out, out_stride);
}
LAGOMORPH_AVX2 void tile_avx2(const Work& work, const Tile& tile, float* out, std::size_t out_stride) {
  tile_body<8>(work, tile, out, out_stride);
}

/// A source row with its halo, clamped to the picture's edge.
void read_row(const LinearPair& pair, int which, const Tile& tile, const Layout& at, int y, float* red,
              float* green, float* blue) {
  const int left = tile.x - static_cast<int>(at.halo);
  const int first = std::max(left, 0);
  const int end = std::min(left + static_cast<int>(at.stride), pair.width());
  const int skip = first - left;
  pair.read(which, y, first, end - first, red + skip, green + skip, blue + skip);
  for (float* channel : {red, green, blue}) {
    std::fill(channel, channel + skip, channel[skip]);
    std::fill(channel + (end - left), channel + at.stride, channel[end - left - 1]);
  }
}

void read_planes(const LinearPair& pair, int which, const Tile& tile, const Layout& at,
                 const Planes& planes) {
  for (std::size_t row = 0; row < at.source_rows; ++row) {
    const int y = tile.y + static_cast<int>(row) - static_cast<int>(at.halo);
    const std::size_t start = row * at.stride;
    read_row(pair, which, tile, at, std::clamp(y, 0, pair.height() - 1), planes.y + start, planes.cx + start,
             planes.cz + start);
  }
}

/// Hands out the scratch memory in pieces.
class Pieces {
public:
  Pieces(std::vector<float>& memory, std::size_t size) {
    if (memory.size() < size) memory.resize(size);
    next_ = memory.data();
  }
  float* take(std::size_t size) { return std::exchange(next_, next_ + size); }

private:
  float* next_;
};

}  // namespace

void flip_tile(const LinearPair& pair, const FlipFilters& filters, const Tile& tile, InstructionSet set,
               std::vector<float>& scratch, float* out, std::size_t out_stride) {
  Work work{.filters = filters, .at = Layout(tile, filters.halo()), .planes = {}, .column = {}, .row = {}};
  const Layout& at = work.at;
  Pieces pieces(scratch, 6 * at.plane + 7 * at.stride + 16 * at.row);
  for (Planes& p : work.planes) {
    for (float** plane : {&p.y, &p.cx, &p.cz}) *plane = pieces.take(at.plane);
  }
  Column& c = work.column;
  for (float** row : {&c.y, &c.cx, &c.cz_1, &c.cz_2, &c.gauss, &c.first, &c.second})
    *row = pieces.take(at.stride);
  for (Row& r : work.row) {
    for (float** row : {&r.l_y, &r.a_cx, &r.b_cz, &r.cz_2, &r.edge_x, &r.edge_y, &r.point_x, &r.point_y}) {
      *row = pieces.take(at.row);
    }
  }
  for (int which = 0; which < 2; ++which) {
    read_planes(pair, which, tile, at, work.planes[static_cast<std::size_t>(which)]);
  }
  (set == InstructionSet::avx2 ? tile_avx2 : tile_base)(work, tile, out, out_stride);
}

}  // namespace lagomorph::render
