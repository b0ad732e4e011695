#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/raster/frame_block.h"
#include "render/raster/pixel_block.h"
#include "render/raster/view_range.h"

/// Points to be lit, in blocks: of the ground, of what is seen of meshes, of the ground's map.
namespace lagomorph::render::raster {

/// A pixel of what surface_fragment says.
struct SurfaceTexel {
  std::uint32_t depth;   // bits of a float, along the view axis [m]
  std::uint32_t normal;  // two fractions in [-1, 1] of 16 bits, on the octahedron
  std::uint32_t raised;  // bits of a float, see Receivers [m]
  std::uint32_t finish;  // 1 + 65534 times the roughness; 0: nothing, or nothing that is lit
};

/// Those of a rectangle of pixels, rows from below.
struct SurfaceTexels {
  PixelRectangle at;
  std::span<const SurfaceTexel> texels;

  /// nullptr: nothing is seen there, or (x, y), from the rectangle's corner, is outside.
  const SurfaceTexel* find(int x, int y) const {
    if (x < 0 || y < 0 || x >= at.width || y >= at.height) return nullptr;
    const SurfaceTexel& t = texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(at.width) +
                                   static_cast<std::size_t>(x)];
    return t.finish == 0 ? nullptr : &t;
  }
};

/// The normal to shade with.
Vec3 normal_of(const SurfaceTexel&);
/// Size of a pixel at a depth along the view axis [m], as pixel_footprint() of the shaders.
float pixel_footprint(const FrameBlock&, float depth);

/// A rectangle of pixels, or of cells of several, as blocks of receivers: rows of blocks from below.
struct ReceiverBlocks {
  int columns = 0, rows = 0;  // of blocks
  int step = 1;               // from one receiver to the next [pixels]
  std::vector<Receivers> blocks;
  std::vector<char> empty;  // 1: nothing is in the block

  int width() const { return columns * block_width; }
  int height() const { return rows * block_height; }
  void resize(int block_columns, int block_rows);
  /// Calls block(x, y, receivers) for those that are not empty, at their lower left corners.
  template <class Block>
  void for_each(const Block& block) const {
    for (int k = 0; k < rows * columns; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (empty[i] == 0) block(k % columns * block_width, k / columns * block_height, blocks[i]);
    }
  }
};

/// Each puts the points of the pixels `step` apart from (x, y) on into a block, and returns whether any is
/// there. Each stands for its cell of step x step pixels: the lower left one where something is seen there.
bool ground_receivers(const FrameBlock&, int x, int y, int step, Receivers&);
bool surface_receivers(const FrameBlock&, const SurfaceTexels&, int x, int y, int step, Receivers&);
/// Of the ground's map, all.
bool ground_map_receivers(const FrameBlock&, int x, int y, int step, Receivers&);

}  // namespace lagomorph::render::raster
