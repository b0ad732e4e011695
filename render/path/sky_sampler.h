#pragma once

#include <vector>

#include "render/path/sampler.h"
#include "render/sky_map.h"

namespace lagomorph::render::path {

/// Directions towards a sky map with a density in solid angle as its luminance: a texel by its share of the
/// light, then evenly over the texel's solid angle.
class SkySampler {
public:
  explicit SkySampler(const SkyMap&);

  struct Sample {
    Vec3 direction = Vec3::Zero();
    float pdf = 0.0F;  // [1/sr]; 0 of a black map
  };
  Sample sample(Pair) const;
  float pdf(const Vec3& direction) const;

private:
  double texel_pdf(int x, int y) const;

  const SkyMap& map_;
  std::vector<double> rows_;     // cumulative share of the rows, height + 1 of them
  std::vector<double> columns_;  // of the texels in each row, width + 1 of them a row
};

}  // namespace lagomorph::render::path
