#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/backends.h"
#include "render/error.h"
#include "render/raster/background_pass.h"
#include "render/raster/body_pass.h"
#include "render/raster/channel_passes.h"
#include "render/raster/frame_block.h"
#include "render/raster/frame_view.h"
#include "render/raster/gl_context.h"
#include "render/raster/gl_objects.h"
#include "render/raster/light_maps.h"
#include "render/raster/ray_pass.h"
#include "render/raster/ray_scene.h"
#include "render/raster/scene_shapes.h"
#include "render/raster/stand_ins.h"
#include "render/raster/supersampled.h"
#include "render/raster/surface_table.h"
#include "render/raster/targets.h"
#include "render/raster/view_range.h"

namespace lagomorph::render {
namespace {

using namespace raster;

void check(const RasterSettings& s) {
  if (s.multisample != 1 && s.multisample != 4) {
    throw SettingsError("render.raster.multisample = " + std::to_string(s.multisample) +
                        " must be 1 or 4 (the software rasterizer's most)");
  }
  if (s.supersample < 1 || s.supersample > 4) {
    throw SettingsError("render.raster.supersample = " + std::to_string(s.supersample) + " must be in 1..4");
  }
  if (s.shadow_map < 256 || s.shadow_map > 8192 || (s.shadow_map & (s.shadow_map - 1)) != 0) {
    throw SettingsError("render.raster.shadow_map = " + std::to_string(s.shadow_map) +
                        " must be a power of two in 256..8192");
  }
  if (s.shadow_samples < 1 || s.shadow_samples > 64) {
    throw SettingsError("render.raster.shadow_samples = " + std::to_string(s.shadow_samples) +
                        " must be in 1..64");
  }
}

class RasterRenderer final : public Renderer {
public:
  RasterRenderer(const RenderSettings& settings, int threads)
      : settings_(settings), context_(make_gl_context(threads)), gl_(std::make_unique<GlSide>(settings)) {}

  ~RasterRenderer() override {
    try {
      context_->make_current();
      gl_.reset();
    } catch (const DeviceError&) {
      // Without a context its names are gone with it.
    }
  }

  std::string_view name() const override { return "raster"; }
  void set_scene(const RenderScene&) override;
  void update_positions(int mesh, std::span<const Vec3> positions) override;
  void update_colors(int mesh, std::span<const Color> colors) override;
  void set_previous(int mesh, std::span<const Vec3> positions) override;
  Image render(const Camera&, const FrameInfo&) override;
  double seconds_reading_back() const override { return seconds_reading_; }
  std::string description() const override;

private:
  /// All that lives in the context.
  struct GlSide {
    explicit GlSide(const RenderSettings& settings)
        : maps(settings.raster), bodies(settings.raster.multisample), channels(settings) {}
    LightMaps maps;
    SceneShapes shapes;
    SurfaceTable surfaces;
    Buffer frame;
    BackgroundPass background;
    BodyPass bodies;
    ChannelPasses channels;
    std::optional<Targets> targets;
    std::optional<RayScene> rays;  // used where meshes are clear or mirror, or the ground mirrors them
  };

  void check_mesh_number(int mesh) const;
  void show_ground(bool shown);
  Targets& targets_for(const Camera&);
  void upload_frame(const Camera&, const ViewRange&);
  BodyPass::View view_of_bodies(const Camera&, const PixelRectangle& drawn) const;
  void draw_with_rays(const Camera&, const BodyPass::View&, std::span<float> color);

  RenderSettings settings_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<GlSide> gl_;
  RenderScene scene_;                         // with_stand_ins(), without meshes
  RenderScene seen_;                          // its ground, and all visible lights of the scene
  std::vector<std::vector<Vec3>> positions_;  // of each mesh
  FrameBlock block_{};
  bool has_colors_ = false;  // some mesh has, of its vertices
  bool lights_are_stale_ = true;
  double seconds_reading_ = 0.0;  // of all targets
  bool has_ground_ = false;       // the scene; scene_ has it where it is drawn
};

void RasterRenderer::set_scene(const RenderScene& scene) {
  check_scene(scene);
  context_->make_current();
  scene_ = with_stand_ins(scene);
  apply_transparency(settings_, scene_);
  has_ground_ = scene_.ground.enabled;
  positions_.clear();
  for (const Mesh& mesh : scene.meshes) positions_.push_back(mesh.positions);
  const DrawnByRays by_rays = drawn_by_rays(scene, settings_.raster);
  gl_->shapes.set_scene(scene, by_rays);
  has_colors_ = gl_->shapes.any(&MeshBuffers::colored);
  gl_->rays.reset();
  if (by_rays.any()) gl_->rays.emplace(scene, scene_, by_rays);
  seen_.ground = scene_.ground;
  seen_.lights.clear();
  std::copy_if(scene.lights.begin(), scene.lights.end(), std::back_inserter(seen_.lights),
               [](const AreaLight& light) { return light.visible; });
  const LightFeatures features = light_features(scene, scene_);
  gl_->surfaces.set_scene(scene, by_rays, seen_.lights, features.sheen);
  gl_->maps.set_scene(scene, scene_, by_rays, features, block_);
  gl_->background.set_scene(scene_, by_rays.ground, features, gl_->surfaces.ground());
  gl_->bodies.set_scene(seen_.lights, features, has_colors_);
  gl_->channels.set_scene(features, has_colors_);
  lights_are_stale_ = true;
  check_gl("taking the scene");
}

void RasterRenderer::check_mesh_number(int mesh) const {
  if (mesh >= 0 && static_cast<std::size_t>(mesh) < positions_.size()) return;
  throw SettingsError("mesh " + std::to_string(mesh) + " is not one of the scene's " +
                      std::to_string(positions_.size()));
}

void RasterRenderer::update_colors(int mesh, std::span<const Color> colors) {
  check_mesh_number(mesh);
  MeshBuffers& buffers = gl_->shapes.meshes()[static_cast<std::size_t>(mesh)];
  check_colors("mesh " + std::to_string(mesh),
               buffers.colored() ? positions_[static_cast<std::size_t>(mesh)].size() : 0, colors);
  context_->make_current();
  buffers.upload(colors);
  if (gl_->rays) gl_->rays->geometry().color(mesh, colors);
}

void RasterRenderer::update_positions(int mesh, std::span<const Vec3> positions) {
  check_mesh_number(mesh);
  std::vector<Vec3>& current = positions_[static_cast<std::size_t>(mesh)];
  if (positions.size() != current.size()) {
    throw SettingsError("mesh " + std::to_string(mesh) + " has " + std::to_string(current.size()) +
                        " positions; " + std::to_string(positions.size()) + " were given");
  }
  if (!std::all_of(positions.begin(), positions.end(), [](const Vec3& p) { return p.allFinite(); }))
    throw SettingsError("mesh " + std::to_string(mesh) + " has a position that is not finite");
  context_->make_current();
  std::copy(positions.begin(), positions.end(), current.begin());
  gl_->shapes.meshes()[static_cast<std::size_t>(mesh)].upload(current);
  if (gl_->rays) gl_->rays->geometry().move(mesh, current);
  lights_are_stale_ = true;
}

void RasterRenderer::set_previous(int mesh, std::span<const Vec3> positions) {
  check_mesh_number(mesh);
  context_->make_current();
  gl_->shapes.meshes()[static_cast<std::size_t>(mesh)].upload_previous(positions);
}

void RasterRenderer::show_ground(bool shown) {
  if (shown == scene_.ground.enabled) return;
  scene_.ground.enabled = seen_.ground.enabled = shown;
  gl_->maps.show_ground(shown, block_);
  if (gl_->rays) gl_->rays->geometry().show_ground(shown);
  gl_->background.show_ground(shown);
  lights_are_stale_ = true;
}

Targets& RasterRenderer::targets_for(const Camera& camera) {
  std::optional<Targets>& targets = gl_->targets;
  if (!targets || targets->width() != camera.width() || targets->height() != camera.height() ||
      targets->colors() != has_colors_) {
    targets.reset();
    targets.emplace(camera.width(), camera.height(), settings_.raster.multisample, has_colors_);
  }
  return *targets;
}

/// With all that the shaders read of the scene, bound.
void RasterRenderer::upload_frame(const Camera& camera, const ViewRange& range) {
  if (lights_are_stale_) gl_->maps.fit(scene_, positions_, gl_->shapes.meshes(), block_);
  set_view(camera, range, scene_.sky, block_);
  glBindBuffer(GL_UNIFORM_BUFFER, gl_->frame.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(FrameBlock), &block_, GL_DYNAMIC_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, gl_->frame.id());
  gl_->maps.bind_textures();
  gl_->surfaces.bind();
  if (lights_are_stale_) gl_->maps.draw(gl_->shapes.meshes(), positions_, block_);
  lights_are_stale_ = false;
}

BodyPass::View RasterRenderer::view_of_bodies(const Camera& camera, const PixelRectangle& drawn) const {
  const PixelRectangle picture = {0, 0, camera.width(), camera.height()};
  const PixelRectangle wanted = common_rectangle(seen_rectangle(camera, positions_, seen_), drawn);
  return {block_, gl_->maps.depths(), ground_may_hide(camera, positions_, scene_.ground),
          common_rectangle(whole_cells(wanted), picture)};
}

Image RasterRenderer::render(const Camera& camera, const FrameInfo& frame) {
  context_->make_current();
  show_ground(has_ground_ && !frame.leaves_out_ground);
  Targets& targets = targets_for(camera);
  const double read_before = targets.seconds_reading();
  const ViewRange range = view_range(camera, positions_, seen_);
  upload_frame(camera, range);

  Image image(camera.width(), camera.height());
  const PixelRectangle picture = {0, 0, camera.width(), camera.height()};
  const PixelRectangle drawn =
      frame.region && !gl_->rays  // rays end anywhere
          ? common_rectangle(with_neighbours(rectangle_of(*frame.region, camera.height())), picture)
          : picture;
  if (gl_->channels.has_alpha()) {  // of all pixels
    targets.bind_seen();
    targets.clear_seen();
  }
  std::vector<float>& color = image.add(color_channel, 3);
  gl_->background.draw(block_, gl_->maps, gl_->surfaces, drawn, color);
  const BodyPass::View bodies = view_of_bodies(camera, drawn);
  if (gl_->rays) {
    draw_with_rays(camera, bodies, color);
  } else {
    gl_->bodies.draw(gl_->shapes, Which::opaque, bodies, targets);
    targets.put_over(color);
  }
  const Camera& before = frame.camera_before != nullptr ? *frame.camera_before : camera;
  const Mat4 clip_before = before.projection(range.near, range.far) * before.view();
  gl_->channels.draw(gl_->shapes, {scene_.ground.enabled, gl_->background.caught(), clip_before}, targets,
                     image);
  seconds_reading_ += targets.seconds_reading() - read_before;
  check_gl("drawing a frame");
  return image;
}

/// Bodies over the picture, which is the background, what the ground mirrors of them and what is seen through
/// them.
void RasterRenderer::draw_with_rays(const Camera& camera, const BodyPass::View& view,
                                    std::span<float> color) {
  Targets& targets = *gl_->targets;
  gl_->rays->geometry().commit();
  const std::span<const float> background = gl_->background.lit(color);
  std::vector<float> still(background.begin(), background.end()), solid;
  DrawnPictures pictures{still, still, {}};
  std::vector<SurfaceTexel> surfaces;
  if (!gl_->shapes.all(&MeshBuffers::clear)) {
    gl_->bodies.draw(gl_->shapes, Which::solid, view, targets);
    solid = still;
    targets.put_over(solid);
    const SurfaceTexels of_solid = gl_->bodies.surfaces();
    surfaces.assign(of_solid.texels.begin(), of_solid.texels.end());
    pictures.solid = solid;
    pictures.surfaces = {of_solid.at, surfaces};
  }
  if (gl_->background.mirrors_by_rays()) {
    add_mirrored_by_ground(*gl_->rays, camera, pictures, mirrored_rectangle(camera, positions_, seen_),
                           color);
  }
  if (gl_->shapes.any(&MeshBuffers::clear)) {
    if (gl_->background.mirrors_by_rays()) std::copy(color.begin(), color.end(), still.begin());
    gl_->bodies.draw(gl_->shapes, Which::opaque, view, targets);
  }
  targets.put_over(color);
  add_by_rays(*gl_->rays, camera, pictures, view.seen, settings_.raster.multisample, color);
}

std::string RasterRenderer::description() const {
  context_->make_current();
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  return context_->platform() + ", " + text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace

std::unique_ptr<Renderer> make_raster_renderer(const RenderSettings& settings, int threads) {
  check(settings.raster);
  const auto make = [threads](const RenderSettings& s) -> std::unique_ptr<Renderer> {
    return std::make_unique<RasterRenderer>(s, threads);
  };
  return settings.raster.supersample > 1 ? make_supersampled(settings, make) : make(settings);
}

}  // namespace lagomorph::render
