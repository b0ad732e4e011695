#include "render/raster/background_pass.h"

#include <algorithm>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "render/path/lane_math.h"
#include "render/raster/ground_tiles.h"
#include "render/raster/pixel_ray.h"

namespace lagomorph::render::raster {

namespace {

void make_for(const LightFeatures& features, int lights, std::optional<StillPicture>& still) {
  if (still && still->is_for(features, lights)) return;
  still.reset();
  still.emplace(features, lights);
}

}  // namespace

void BackgroundPass::set_scene(const RenderScene& drawn, bool by_rays, const LightFeatures& features,
                               const SurfaceBlock& ground) {
  ground_ = drawn.ground;
  by_rays_ = by_rays;
  const int lights = static_cast<int>(drawn.lights.size());
  make_for(features, lights, still_);
  still_->set_ground(ground);
  if (!catches_shadows()) {
    matte_.reset();
    return;
  }
  LightFeatures untextured = features;
  untextured.ground_texture = 0;
  make_for(untextured, lights, matte_);
  matte_->set_ground(matte_ground());
}

void BackgroundPass::show_ground(bool shown) {
  ground_.enabled = shown;
  still_->forget();
  if (matte_) matte_->forget();
}

bool BackgroundPass::mirrors_by_rays() const { return by_rays_ && ground_.enabled && !catches_shadows(); }

void BackgroundPass::draw(const FrameBlock& block, const LightMaps& maps, const SurfaceTable& surfaces,
                          const PixelRectangle& drawn, std::span<float> color) {
  const std::vector<TileRun> tiles = touched_tiles(block, maps.casters(), maps.least_map(), drawn);
  light_ground(block, maps.depths(), tiles, lit_);
  draw_ground(block, maps, tiles, drawn, *still_, color);
  caught_.clear();
  lit_ground_.clear();
  if (!catches_shadows()) return;
  lit_ground_.assign(color.begin(), color.end());
  FrameBlock direct = block;  // what meshes send back is not their shadow
  direct.mesh_albedo.setZero();
  surfaces.bind_matte_ground();
  draw_ground(direct, maps, tiles, drawn, *matte_, color);
  surfaces.bind();
  catch_shadows(block, drawn, color);
}

void BackgroundPass::draw_ground(const FrameBlock& block, const LightMaps& maps,
                                 std::span<const TileRun> tiles, const PixelRectangle& drawn,
                                 StillPicture& still, std::span<float> color) {
  copy_less_taken(block, still.draw(block, tiles), maps.ground_seen(), tiles, lit_, drawn, mirrors_by_rays(),
                  color);
}

/// Of the matte ground only what is taken of its light is left, as alpha: black is behind its fading edge.
void BackgroundPass::catch_shadows(const FrameBlock& block, const PixelRectangle& drawn,
                                   std::span<float> color) {
  const StillParts& still = matte_->still();
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
