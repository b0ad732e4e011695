#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/raster/frame_block.h"
#include "render/raster/ground_tiles.h"
#include "render/raster/still_parts.h"

/// The picture without the meshes, between the corners of cells of pixels: the ground's light changes little
/// from one pixel to the next, but for highlights and what is far away.
namespace lagomorph::render::raster {

constexpr int still_cell = 4;  // its side [pixels]
constexpr int still_cells_of_tile = tile_size / still_cell;

/// What still_fragment says at the corners (CELLS), from the picture's lower left one on.
struct StillCells {
  int columns = 0, rows = 0;  // of corners, as many as whole tiles have
  std::vector<char> met;      // the ground is there
  /// A plane a channel: what the ground sends, then StillParts::planes. Of the ground's own colour, and of
  /// its texture's where it has one.
  std::array<std::vector<float>, 2> planes;

  std::size_t corners() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  int tile_columns() const { return (columns - 1) / still_cells_of_tile; }
  int tile_rows() const { return (rows - 1) / still_cells_of_tile; }
};

/// How a tile of the still picture comes about: nothing but background; of cells, with the background behind
/// its fading edge or without; drawn pixel by pixel.
enum class StillTile : char { background, fading, solid, each_pixel };

/// Of each tile, row by row from below. `each_pixel`: the ground may have highlights narrower than cells.
std::vector<StillTile> still_tiles(const FrameBlock&, const StillCells&, bool each_pixel);

/// What has no cells (backdrop_fragment), rows from below: three colours and the texture's part a pixel;
/// empty where the background is one colour and the ground is too.
using Backdrop = std::vector<float>;

/// The picture of all tiles that are not drawn pixel by pixel.
void fill_picture(const FrameBlock&, const StillCells&, std::span<const StillTile>, const Backdrop&,
                  StillParts&);
/// The planes of tile (x, y), which is one of cells or of background.
void fill_planes(const FrameBlock&, const StillCells&, StillTile, int x, int y, const Backdrop&, StillParts&);

}  // namespace lagomorph::render::raster
