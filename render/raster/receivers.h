#pragma once

#include <array>
#include <cstddef>
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
  std::uint32_t raised;  // lower half: bits of a half float, see Receivers [m]; upper: the surface's number
  std::uint32_t finish;  // lower half: see lit(); upper: the samples of the layer

  /// 1 + 65534 times the roughness; 0: nothing, or nothing that is lit.
  std::uint32_t lit() const { return finish & 0xffffU; }
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
    return t.lit() == 0 ? nullptr : &t;
  }
};

/// The normal to shade with.
Vec3 normal_of(const SurfaceTexel&);
/// Size of a pixel at a depth along the view axis [m], as pixel_footprint() of the shaders.
float pixel_footprint(const FrameBlock&, float depth);

/// Of a block's quads, the lower left receiver.
struct QuadPlace {
  int x, y;
};

/// Quads from anywhere; the lanes beyond `used` are not there.
struct ReceiverBlock {
  Receivers at;
  std::array<QuadPlace, quads> places;
  int used = 0;

  std::span<const QuadPlace> used_places() const { return {places.data(), static_cast<std::size_t>(used)}; }
  /// Calls to(lane, x, y) for the receivers of its quads.
  template <class To>
  void for_lanes(const To& to) const {
    for (int lane = 0; lane < used * quad; ++lane) {
      const QuadPlace& place = places[static_cast<std::size_t>(lane / quad)];
      to(static_cast<std::size_t>(lane), place.x + (lane & 1), place.y + row(lane));
    }
  }
};

/// Of a grid of width x height receivers, those quads that are wanted: many lanes of few blocks.
struct ReceiverBlocks {
  int width = 0, height = 0;
  int step = 1;  // from one receiver to the next [pixels]
  std::vector<ReceiverBlock> blocks;

  bool empty() const { return blocks.empty() || blocks.front().used == 0; }
  /// The quad at (x, y) if put(first lane, receivers) says that something is there.
  template <class Put>
  void add(int x, int y, const Put& put) {
    if (blocks.empty() || blocks.back().used == quads) begin_block();
    ReceiverBlock& block = blocks.back();
    if (!put(quad * block.used, block.at)) return;
    block.places[static_cast<std::size_t>(block.used)] = {x, y};
    ++block.used;
  }

private:
  void begin_block();
};

/// Each puts the points of the quad of pixels `step` apart from (x, y) on into lanes from the first on, and
/// returns whether any is there. Each stands for its cell of step x step pixels: the lower left one where
/// something is seen there.
bool ground_receivers(const FrameBlock&, int x, int y, int step, int first_lane, Receivers&);
bool surface_receivers(const FrameBlock&, const SurfaceTexels&, int x, int y, int step, int first_lane,
                       Receivers&);
/// Of the ground's map, all.
bool ground_map_receivers(const FrameBlock&, int x, int y, int step, int first_lane, Receivers&);

}  // namespace lagomorph::render::raster
