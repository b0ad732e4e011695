#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "render/raster/by_rays.h"
#include "render/raster/caster_grid.h"
#include "render/raster/frame_block.h"
#include "render/raster/gl_objects.h"
#include "render/raster/light_parts.h"
#include "render/raster/light_view.h"
#include "render/raster/lit_texture.h"
#include "render/raster/mesh_buffers.h"
#include "render/raster/programs.h"
#include "render/raster/still_parts.h"
#include "render/render_scene.h"
#include "render/settings.h"

namespace lagomorph::render::raster {

/// What lies between light and surface: a depth map a light, one a direction of the sky, for the CPU to look
/// up, and a map of the light on the ground under the meshes. All of it depends on the meshes' positions, not
/// on the camera.
class LightMaps {
public:
  explicit LightMaps(const RasterSettings&);

  /// Lights, sky and ground of a scene into the frame's block, for shaders with these features: of what is
  /// drawn in its place (with_stand_ins()), but for its meshes and the map of the sky that the camera sees.
  void set_scene(const RenderScene&, const RenderScene& drawn, const DrawnByRays&, const LightFeatures&,
                 FrameBlock&);
  /// Whether the ground is drawn; what is fitted is to be drawn again.
  void show_ground(bool shown, FrameBlock&);
  /// Fits the maps to new positions and says so in the frame's block.
  void fit(const RenderScene&, std::span<const std::vector<Vec3>> positions,
           std::span<const MeshBuffers> meshes, FrameBlock&);
  /// Where the meshes are in the lights' views, a grid each.
  std::span<const CasterGrid> casters() const { return casters_; }
  /// Size of the smallest of the lights' maps [texels].
  int least_map() const { return least_map_; }
  /// Draws the maps of what was fitted; the block is bound.
  void draw(std::span<const MeshBuffers> meshes, std::span<const std::vector<Vec3>> positions,
            const FrameBlock&);
  /// The depth maps of what was drawn.
  const DepthMaps& depths() const { return depths_; }
  /// What the ground under the meshes sees of the sky, of what was drawn.
  const GroundSeen& ground_seen() const { return ground_seen_; }
  /// Binds all maps and tables where the shaders expect them.
  void bind_textures() const;

private:
  void set_sky_map(const RenderScene& drawn, const SkyMap& seen, FrameBlock&);
  void put_parts(std::size_t light, const LightView& whole, const LightFrame&,
                 std::span<const std::vector<Vec3>> positions, const LightBlock&);
  void fill_bounce_levels();

  RasterSettings settings_;
  std::optional<Program> ground_program_;  // for features_
  LightFeatures features_;
  Texture sky_table_, coat_table_, ground_bounce_;
  LitTexture ground_lit_texture_;
  /// A map of the sky, see sky_light.h.
  struct SkyTextures {
    Texture irradiance_above, radiance_below, lobes_above, lobes_below, picture;
  };
  std::optional<SkyTextures> sky_textures_;
  Framebuffer ground_target_;
  VertexArray no_attributes_;
  std::vector<LightSplit> splits_;  // of the lights
  std::vector<LightView> views_;    // of all their parts
  std::vector<CasterGrid> casters_;
  DepthMaps depths_;
  LitPixels ground_lit_;
  GroundSeen ground_seen_;
  std::vector<Vec4> bounce_;
  int least_map_ = 0;
  bool has_meshes_ = false;
  bool ground_ = false;
};

}  // namespace lagomorph::render::raster
