#pragma once

#include <array>
#include <optional>
#include <vector>

#include "render/raster/depth_maps.h"
#include "render/raster/frame_block.h"
#include "render/raster/lit_pixels.h"
#include "render/raster/programs.h"
#include "render/raster/receivers.h"
#include "render/raster/scene_shapes.h"
#include "render/raster/targets.h"

namespace lagomorph::render::raster {

/// Bodies and visible lights: what is seen of them in each sample, then lit once a pixel and surface.
class BodyPass {
public:
  explicit BodyPass(int multisample) : multisample_(multisample) {}

  /// `lights`: the visible ones; `colors`: meshes have colours of their vertices.
  void set_scene(const std::vector<AreaLight>& lights, const LightFeatures&, bool colors);

  /// What they are seen and lit by.
  struct View {
    const FrameBlock& block;  // bound, as all maps are
    const DepthMaps& depths;
    bool behind_ground;   // some may be
    PixelRectangle seen;  // where they may be
  };
  /// Into what the targets read to be put over the picture.
  void draw(const SceneShapes&, Which, const View&, Targets&);
  /// Of the layer that was drawn last.
  SurfaceTexels surfaces() const { return {surfaces_at_, surfaces_}; }

private:
  struct LayerPass {
    const Program &surface, &layer;
    const Program* plain;  // of pixels that need no more; nullptr: there are none
    GLenum weight_of_drawn;
    bool peeled;
  };
  const SeenPrograms& seen() const { return *seen_[colors_ ? 1 : 0]; }
  const PeelPrograms& peel() const { return *peel_[colors_ ? 1 : 0]; }
  void draw_seen(const SceneShapes&, Which, bool behind_ground, const Targets&) const;
  void draw_layers(const SceneShapes&, const View&, const LayerPass&, Targets&);
  void draw_see_through(const SceneShapes&, const View&, Targets&);

  int multisample_;
  LightFeatures features_;
  bool colors_ = false;
  std::vector<AreaLight> lights_;
  std::optional<BodyPrograms> programs_;
  std::array<std::optional<SeenPrograms>, 2> seen_;  // without and with colours, compiled when they are used
  std::array<std::optional<PeelPrograms>, 2> peel_;  // likewise; where a mesh is not opaque
  std::vector<SurfaceTexel> surfaces_;
  PixelRectangle surfaces_at_;
  LitPixels lit_;
};

}  // namespace lagomorph::render::raster
