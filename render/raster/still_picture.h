#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/raster/frame_block.h"
#include "render/raster/gl_objects.h"
#include "render/raster/ground_tiles.h"
#include "render/raster/programs.h"
#include "render/raster/still_cells.h"
#include "render/raster/still_parts.h"

namespace lagomorph::render::raster {

/// Background and ground as they are without the meshes, which is what most pixels of most frames show: drawn
/// again only where the camera is not as before, and but for highlights between the corners of cells.
class StillPicture {
public:
  /// Of scenes with these features and so many lights.
  StillPicture(const LightFeatures&, int lights);

  bool is_for(const LightFeatures& features, int lights) const {
    return features == features_ && lights == still_.lights;
  }
  /// The lights or the ground are others now.
  void forget() {
    seen_by_.reset();
    light_of_ground_below_.reset();
  }
  void set_ground(const SurfaceBlock&);
  /// Draws it where it is not there yet; the frame's block and all maps are bound. What the meshes take is
  /// there in these tiles at least.
  const StillParts& draw(const FrameBlock&, std::span<const TileRun>);
  /// As it was drawn last.
  const StillParts& still() const { return still_; }

private:
  /// What it depends on beside the scene.
  struct View {
    Vec4 eye, forward, right, up, viewport, sky_picture;
    bool operator==(const View&) const = default;
  };
  /// Of still_fragment.
  struct Target {
    Target(int width, int height, std::size_t parts, GLenum parts_format);
    int width, height;
    Texture picture, parts;
    Framebuffer target;
  };
  struct BackdropTarget {
    BackdropTarget(int width, int height);
    Texture texture;
    Framebuffer target;
  };

  void draw_picture(const FrameBlock&);
  void draw_cells();
  void draw_backdrop(const FrameBlock&);
  void draw_tiles();
  void read_tiles(std::span<const int> numbers);
  void draw_light();
  bool has_texture() const { return features_.ground_texture > 0; }

  LightFeatures features_;
  Program cells_program_, light_program_;
  std::optional<Program> tiles_program_, backdrop_program_;  // compiled when they are needed
  VertexArray no_attributes_;
  std::optional<Target> cells_target_, tiles_target_;
  std::optional<BackdropTarget> backdrop_target_;
  std::optional<View> seen_by_;
  std::optional<bool> light_of_ground_below_;  // whether it is that of the upper side
  bool each_pixel_ = false;                    // see still_tiles()
  StillCells cells_;
  std::vector<StillTile> tiles_;
  std::vector<char> has_planes_;  // a tile each
  Backdrop backdrop_;
  StillParts still_;
  std::vector<float> values_;
  std::vector<std::uint16_t> halves_;
};

}  // namespace lagomorph::render::raster
