#pragma once

#include <optional>
#include <span>

#include "render/raster/frame_block.h"
#include "render/raster/gl_objects.h"
#include "render/raster/ground_tiles.h"
#include "render/raster/programs.h"

namespace lagomorph::render::raster {

/// Background and ground as they are without the meshes, which is what most pixels of most frames show: drawn
/// again only where the camera is not as before.
class StillPicture {
public:
  /// Of scenes with these features and so many lights.
  StillPicture(const LightFeatures&, int lights);

  bool is_for(const LightFeatures& features, int lights) const {
    return features == features_ && lights == lights_;
  }
  /// The lights or the ground are others now.
  void forget() { seen_by_.reset(); }
  /// Draws it where it is not there yet; the frame's block and all maps are bound.
  void draw(const FrameBlock&);
  const Texture& picture() const { return sized_->picture; }
  /// The picture with the meshes' light, of these tiles, into the bound framebuffer of the same size.
  void draw_touched(std::span<const TileRun>) const;

private:
  /// What it depends on beside the scene.
  struct View {
    Vec4 eye, forward, right, up, viewport, sky_picture;
    bool operator==(const View&) const = default;
  };
  struct Sized {
    Sized(int width, int height, int parts);
    int width, height;
    Texture picture, parts;
    Framebuffer target;
  };

  int parts() const { return 2 + lights_ + (features_.sky_map ? 1 : 0); }

  LightFeatures features_;
  int lights_;
  Program still_, taken_;
  std::optional<Sized> sized_;
  std::optional<View> seen_by_;
  VertexArray no_attributes_, tiles_;
  Buffer tile_buffer_;
};

}  // namespace lagomorph::render::raster
