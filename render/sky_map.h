#pragma once

#include <vector>

#include "render/types.h"

namespace lagomorph::render {

/// Radiance from all around as a picture in latitude and longitude: the top row is straight up (+y), the
/// middle column faces -z, and +x is a quarter to the right of it. Between the texels' centres it is
/// bilinear.
class SkyMap {
public:
  /// `texels` in rows from the top, width * height of them, finite and >= 0. `rotation` turns the map until
  /// its middle faces that azimuth [degrees]: 0 is -z, 90 is +x. Throws SettingsError for a value or size
  /// that is none.
  SkyMap(int width, int height, std::vector<Color> texels, float rotation = 0.0F);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Azimuth that the middle faces, in turns from -z.
  float turn() const { return turn_; }
  const std::vector<Color>& texels() const { return texels_; }
  const Color& texel(int x, int y) const {
    return texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }
  /// Place of a unit direction in the map, both in [0, 1], from the left and from the top.
  Vec2 place(const Vec3& direction) const;
  /// And back, of any u and v in [0, 1].
  Vec3 direction(double u, double v) const;
  Color radiance(const Vec3& direction) const;

private:
  int width_, height_;
  float turn_;  // of the middle from -z, in turns
  std::vector<Color> texels_;
};

}  // namespace lagomorph::render
