#pragma once

#include <optional>
#include <vector>

#include "render/raster/frame_block.h"
#include "render/raster/gl_objects.h"
#include "render/raster/programs.h"
#include "render/raster/still_parts.h"

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
  void forget() {
    seen_by_.reset();
    light_of_ground_below_.reset();
  }
  /// Draws it where it is not there yet; the frame's block and all maps are bound. What the meshes take is
  /// there in these rows of pixels at least.
  const StillParts& draw(const FrameBlock&, int first_row, int last_row);

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

  int parts() const { return 3 + lights_; }

  LightFeatures features_;
  int lights_;
  void read_picture();
  void read_light();
  void read_rows(int first, int last);

  Program still_, light_;
  std::optional<Sized> sized_;
  std::optional<View> seen_by_;
  std::optional<bool> light_of_ground_below_;  // whether it is that of the upper side
  VertexArray no_attributes_;
  StillParts read_;
  int first_row_ = 0, last_row_ = 0;  // of read_.planes
  std::vector<float> values_;
  std::vector<std::uint16_t> halves_;
};

}  // namespace lagomorph::render::raster
