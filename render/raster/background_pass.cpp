#include "render/raster/background_pass.h"

#include <algorithm>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "render/path/lane_math.h"
#include "render/raster/ground_tiles.h"
#include "render/raster/pixel_ray.h"
#include "render/raster/ray_scene.h"

namespace lagomorph::render::raster {

void BackgroundPass::set_scene(const RenderScene& drawn, const LightFeatures& features,
                               const SurfaceBlock& ground) {
  ground_ = drawn.ground;
  const int lights = static_cast<int>(drawn.lights.size());
  if (!still_ || !still_->is_for(features, lights)) {
    still_.reset();
    still_.emplace(features, lights);
  }
  still_->set_ground(ground);
}

void BackgroundPass::show_ground(bool shown) {
  ground_.enabled = shown;
  still_->forget();
}

bool BackgroundPass::mirrors_by_rays() const {
  return raster::mirrors_by_rays(ground_) && !catches_shadows();
}

void BackgroundPass::draw(const FrameBlock& block, const LightMaps& maps, const PixelRectangle& drawn,
                          std::span<float> color) {
  const std::vector<TileRun> tiles = touched_tiles(block, maps.casters(), maps.least_map(), drawn);
  const StillParts& still = still_->draw(block, tiles);
  light_ground(block, maps.depths(), tiles, lit_);
  copy_less_taken(block, still, maps.ground_seen(), tiles, lit_, drawn, mirrors_by_rays(), color);
  caught_.clear();
  lit_ground_.clear();
  if (!catches_shadows()) return;
  lit_ground_.assign(color.begin(), color.end());
  catch_shadows(block, still, drawn, color);
}

/// Of the ground only what is taken of its light is left, as alpha: black is behind its fading edge.
void BackgroundPass::catch_shadows(const FrameBlock& block, const StillParts& still,
                                   const PixelRectangle& drawn, std::span<float> color) {
  const auto width = static_cast<std::size_t>(still.width);
  caught_.assign(still.pixels(), 0.0F);
  const bool from_above = ground_is_below(block);
  const auto luminance = [](const float* c) { return path::luminance({c[0], c[1], c[2]}); };
  tbb::parallel_for(drawn.y, drawn.y + drawn.height, [&](int y) {
    for (int x = drawn.x; x < drawn.x + drawn.width; ++x) {
      const std::size_t from_below = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      const std::size_t at =
          static_cast<std::size_t>(still.height - 1 - y) * width + static_cast<std::size_t>(x);
      float* const left = color.data() + 3 * at;
      const float all = luminance(still.picture.data() + 3 * from_below), reached = luminance(left);
      std::fill_n(left, 3, 0.0F);
      const auto ground = ground_at_pixel(block, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      if (!ground || !from_above || !(all > 0.0F)) continue;
      const float there = 1.0F - ground_fade(ground_, ground->point);
      caught_[at] = there * std::clamp(1.0F - reached / all, 0.0F, 1.0F);
    }
  });
}

}  // namespace lagomorph::render::raster
