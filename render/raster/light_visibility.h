#pragma once

#include "render/raster/depth_maps.h"
#include "render/raster/frame_block.h"
#include "render/raster/pixel_block.h"

/// Part of a light's rectangle, or of a part of it (LightPart), that each point sees, by how much of its
/// light falls there: percentage-closer soft shadows [Fernando 2005] with the light's own rectangle for a
/// filter. Seen from the light's centre, a point at tangents t and distance z, and the rectangle's point s:
/// what lies between them at distance b appears at t
/// + s (1/b - 1/z). So reciprocal distances, which the depth map holds up to a scale, are averaged. A texel
/// blocks if the surface that it saw is nearer than the receiver and above the receiver's smooth surface: no
/// surface can shadow itself by the map's resolution, nothing needs to be pushed away from the light, and no
/// triangles show.
///
/// The four pixels of a quad look at different points; what they find is to be shared by neighbours between
/// the two steps and after them (soft_shadow()).
namespace lagomorph::render::raster {

/// What is before the light, over the taps of the search.
struct alignas(64) Blockers {
  Lanes nearness;  // weighted sum of 1 / distance from the light over the taps that are blocked [1/m]
  Lanes taps;      // sum of their weights
  Lanes depth;     // the receiver's along the view axis [m]; of one that is not lit unlike any other
};
/// `spacing`: of the receivers [pixels]; where it is more than one, what hides a small light anywhere up to
/// the next is found.
void find_blockers(const DepthMaps&, std::size_t part, const Receivers&, float spacing, Blockers&);

/// Over the taps of the filter, which is as wide as what was found says, and of a small light over the pixel.
struct alignas(64) Shadow {
  Lanes blocked;  // part of them
  Lanes share;    // in [0, 1], of neighbours: none where the penumbra is hardly wider than a pixel
  LaneBits hard;  // receivers beside which a small light's edge is too narrow to be seen from one to the next
};
void filter_shadow(const DepthMaps&, std::size_t part, const Receivers&, const Blockers&, float spacing,
                   Shadow&);

/// Irradiance that a part of a light sends to each receiver, up to a factor that is the same for all parts of
/// the light: of what is above the receiver's horizon, and of that what the ground does not hide.
struct alignas(64) PartLight {
  Lanes whole, past_ground;
};
void light_of_part(const FrameBlock&, const LightBlock&, const Receivers&, PartLight&);

}  // namespace lagomorph::render::raster
