#pragma once

#include <vector>

#include "render/image.h"
#include "render/raster/gl_objects.h"
#include "render/raster/programs.h"
#include "render/types.h"

namespace lagomorph::render::raster {

/// The channels normal, albedo, position, motion and triangle_id, drawn in one pass of one sample a pixel, so
/// that they are those of the surface at its centre.
class DataPass {
public:
  /// `colors`: meshes may have colours of their vertices. Throws DeviceError when it cannot be had.
  DataPass(int width, int height, bool colors, const LightFeatures&);

  int width() const { return width_; }
  int height() const { return height_; }
  bool colors() const { return colors_; }
  const Program& mesh() const { return mesh_; }
  const Program& ground() const { return ground_; }

  /// Binds an empty target. `clip_before`: world to clip of the camera at the frame before.
  void begin(const Mat4& clip_before) const;
  /// What was drawn into those of its channels that the image has, rows from the top.
  void read(Image&);

private:
  int width_, height_;
  bool colors_;
  Program mesh_, ground_;
  Texture position_and_triangle_, normal_and_motion_x_, albedo_and_motion_y_;
  Renderbuffer depth_;
  Framebuffer target_;
  std::vector<float> pixels_;
};

}  // namespace lagomorph::render::raster
