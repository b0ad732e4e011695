#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/raster/light_view.h"
#include "render/render_scene.h"

namespace lagomorph::render::raster {

/// Where in a light's shadow map something may be, in cells of a 64th of it: what looks for blockers
/// elsewhere finds none.
class CasterGrid {
public:
  static constexpr int size = 64;

  /// The rectangle between two corners, in the map's [0, 1]; what is beyond does not count.
  void add(const Vec2& low, const Vec2& high);
  void fill() { rows_.fill(~std::uint64_t{0}); }
  /// Whether a rectangle meets something.
  bool meets(const Vec2& low, const Vec2& high) const;

private:
  std::array<std::uint64_t, size> rows_{};  // a bit a cell
};

/// Marks the triangles as the light's view sees them; all cells where one reaches the light's plane.
void add_casters(const AreaLight&, const LightView&, std::span<const Vec3> positions,
                 std::span<const Triangle>, CasterGrid&);

}  // namespace lagomorph::render::raster
