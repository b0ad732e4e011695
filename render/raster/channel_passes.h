#pragma once

#include <optional>
#include <span>

#include "render/channels.h"
#include "render/image.h"
#include "render/raster/data_pass.h"
#include "render/raster/programs.h"
#include "render/raster/scene_shapes.h"
#include "render/raster/targets.h"
#include "render/settings.h"

namespace lagomorph::render::raster {

/// The channels beside the picture: alpha of the samples that say what is seen, the others of one sample a
/// pixel, so that they are those of the surface at its centre. Programs are compiled when they are asked for.
class ChannelPasses {
public:
  explicit ChannelPasses(const RenderSettings& settings) : settings_(settings) {}

  /// `colors`: meshes have colours of their vertices.
  void set_scene(const LightFeatures&, bool colors);
  bool has_alpha() const { return settings_.transparent || wants(alpha_channel); }

  struct View {
    bool has_ground;
    std::span<const float> caught;  // alpha of a ground that catches shadows; empty: it does not
    const Mat4& clip_before;        // world to clip of the camera at the frame before
  };
  /// All that the settings ask for, after the bodies; the frame's block is bound.
  void draw(const SceneShapes&, const View&, Targets&, Image&);

private:
  bool wants(const char* channel) const;
  const DepthPrograms& depth_programs();
  void draw_depth(const SceneShapes&, bool has_ground, Targets&, Image&);
  void draw_body_ids(const SceneShapes&, bool has_ground, Targets&, Image&);
  void draw_alpha(const SceneShapes&, std::span<const float> caught, Targets&, Image&);
  void draw_data(const SceneShapes&, const View&, Image&);

  RenderSettings settings_;
  LightFeatures features_;
  bool colors_ = false;
  std::optional<DepthPrograms> depth_;
  std::optional<Program> mesh_number_, alpha_;
  std::optional<DataPass> data_;
};

}  // namespace lagomorph::render::raster
