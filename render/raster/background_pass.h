#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/raster/light_maps.h"
#include "render/raster/lit_pixels.h"
#include "render/raster/still_picture.h"
#include "render/raster/surface_table.h"

namespace lagomorph::render::raster {

/// What is behind the bodies: the background, and over it the ground under their shadows.
class BackgroundPass {
public:
  /// `drawn`: with_stand_ins() of the scene, whose ground catches shadows only in transparent pictures;
  /// `by_rays`: rays show what the ground mirrors of the meshes.
  void set_scene(const RenderScene& drawn, bool by_rays, const LightFeatures&, const SurfaceBlock& ground);
  void show_ground(bool shown);
  /// A rectangle of it into a linear colour, interleaved, rows from the top. The frame's block and all maps
  /// are bound, and these surfaces.
  void draw(const FrameBlock&, const LightMaps&, const SurfaceTable&, const PixelRectangle&,
            std::span<float> color);

  /// Alpha of a ground that catches shadows, rows from the top; empty where it does not.
  std::span<const float> caught() const { return caught_; }
  /// What was drawn, `color`; with the ground that catches shadows as it is lit.
  std::span<const float> lit(std::span<const float> color) const {
    return lit_ground_.empty() ? color : std::span<const float>(lit_ground_);
  }
  /// Whether rays show what the ground mirrors.
  bool mirrors_by_rays() const;

private:
  bool catches_shadows() const { return ground_.enabled && ground_.shadow_catcher; }
  void draw_ground(const FrameBlock&, const LightMaps&, std::span<const TileRun>, const PixelRectangle&,
                   StillPicture&, std::span<float> color);
  void catch_shadows(const FrameBlock&, const PixelRectangle&, std::span<float> color);

  Ground ground_;
  bool by_rays_ = false;
  std::optional<StillPicture> still_;
  std::optional<StillPicture> matte_;  // of a ground that catches shadows, white and without texture
  LitPixels lit_;
  std::vector<float> caught_, lit_ground_;
};

}  // namespace lagomorph::render::raster
