#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/backends.h"
#include "render/error.h"
#include "render/raster/frame_block.h"
#include "render/raster/gl_context.h"
#include "render/raster/gl_objects.h"
#include "render/raster/light_maps.h"
#include "render/raster/mesh_buffers.h"
#include "render/raster/shaders/shaders.h"
#include "render/raster/targets.h"
#include "render/raster/view_range.h"

namespace lagomorph::render {
namespace {

using namespace raster;

RasterSettings checked(const RasterSettings& s) {
  if (s.multisample != 1 && s.multisample != 4) {
    throw SettingsError("render.raster.multisample = " + std::to_string(s.multisample) +
                        " must be 1 or 4 (the software rasterizer's most)");
  }
  if (s.shadow_map < 256 || s.shadow_map > 8192 || (s.shadow_map & (s.shadow_map - 1)) != 0) {
    throw SettingsError("render.raster.shadow_map = " + std::to_string(s.shadow_map) +
                        " must be a power of two in 256..8192");
  }
  if (s.shadow_samples < 1 || s.shadow_samples > 64) {
    throw SettingsError("render.raster.shadow_samples = " + std::to_string(s.shadow_samples) +
                        " must be in 1..64");
  }
  return s;
}

struct Programs {
  Program background{"background",
                     {shaders::full_screen_vertex},
                     {shaders::frame, shaders::sky, shaders::background_fragment}};
  Program mesh{
      "mesh",
      {shaders::frame, shaders::mesh_vertex},
      {shaders::frame, shaders::brdf, shaders::shadow, shaders::sky, shaders::shade, shaders::mesh_fragment}};
  Program ground{"ground",
                 {shaders::frame, shaders::ground_vertex},
                 {shaders::frame, shaders::brdf, shaders::shadow, shaders::sky, shaders::shade,
                  shaders::ground_point, shaders::ground_fragment}};
  Program emitter{
      "emitter", {shaders::frame, shaders::emitter_vertex}, {shaders::frame, shaders::emitter_fragment}};
  Program mesh_depth{
      "mesh depth", {shaders::frame, shaders::mesh_vertex}, {shaders::frame, shaders::mesh_depth_fragment}};
  Program ground_depth{"ground depth",
                       {shaders::frame, shaders::ground_vertex},
                       {shaders::frame, shaders::ground_point, shaders::ground_depth_fragment}};
};

class RasterRenderer final : public Renderer {
public:
  RasterRenderer(const RenderSettings& settings, int threads)
      : settings_(settings),
        raster_(checked(settings.raster)),
        context_(make_gl_context(threads)),
        gl_(std::make_unique<GlSide>(raster_)) {}

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
  Image render(const Camera&, const FrameInfo&) override;
  std::string description() const override;

private:
  /// All that lives in the context.
  struct GlSide {
    explicit GlSide(const RasterSettings& settings) : maps(settings) {}
    Programs programs;
    LightMaps maps;
    Buffer frame;
    VertexArray no_attributes;
    std::vector<MeshBuffers> meshes;
    std::optional<Targets> targets;
  };

  void upload_frame(const Camera&);
  void draw_color();
  void draw_depth();

  RenderSettings settings_;
  RasterSettings raster_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<GlSide> gl_;
  RenderScene scene_;                         // but for the meshes
  std::vector<std::vector<Vec3>> positions_;  // of each mesh
  FrameBlock block_{};
  bool lights_are_stale_ = true;
};

void set_material(const Program& program, const Material& m) {
  const float r = (m.ior - 1.0F) / (m.ior + 1.0F);
  glUniform3f(program.location("base_color"), m.base_color.x(), m.base_color.y(), m.base_color.z());
  glUniform4f(program.location("finish"), m.roughness, m.metallic, r * r, 0.0F);
}

void RasterRenderer::set_scene(const RenderScene& scene) {
  check_scene(scene);
  if (scene.lights.size() > static_cast<std::size_t>(most_lights)) {
    throw SettingsError("the raster back end draws at most " + std::to_string(most_lights) +
                        " lights; this scene has " + std::to_string(scene.lights.size()));
  }
  context_->make_current();
  scene_ = scene;
  scene_.meshes.clear();
  positions_.clear();
  gl_->meshes.clear();
  for (const Mesh& mesh : scene.meshes) {
    gl_->meshes.emplace_back(mesh);
    positions_.push_back(mesh.positions);
  }
  gl_->maps.set_scene(scene_, block_);
  lights_are_stale_ = true;
  check_gl("taking the scene");
}

void RasterRenderer::update_positions(int mesh, std::span<const Vec3> positions) {
  if (mesh < 0 || static_cast<std::size_t>(mesh) >= positions_.size()) {
    throw SettingsError("mesh " + std::to_string(mesh) + " is not one of the scene's " +
                        std::to_string(positions_.size()));
  }
  std::vector<Vec3>& current = positions_[static_cast<std::size_t>(mesh)];
  if (positions.size() != current.size()) {
    throw SettingsError("mesh " + std::to_string(mesh) + " has " + std::to_string(current.size()) +
                        " positions; " + std::to_string(positions.size()) + " were given");
  }
  if (!std::all_of(positions.begin(), positions.end(), [](const Vec3& p) { return p.allFinite(); }))
    throw SettingsError("mesh " + std::to_string(mesh) + " has a position that is not finite");
  context_->make_current();
  std::copy(positions.begin(), positions.end(), current.begin());
  gl_->meshes[static_cast<std::size_t>(mesh)].upload(current);
  lights_are_stale_ = true;
}

void RasterRenderer::upload_frame(const Camera& camera) {
  const ViewRange range = view_range(camera, positions_, scene_);
  const Mat4 projection = camera.projection(range.near, range.far);
  const auto width = static_cast<float>(camera.width());
  const auto height = static_cast<float>(camera.height());
  block_.clip_from_world = projection * camera.view();
  block_.eye = vec4(camera.position(), camera.is_orthographic() ? 1.0F : 0.0F);
  block_.forward = vec4(camera.forward(), 0.0F);
  block_.right = vec4(Vec3(camera.right() / projection(0, 0)), 0.0F);
  block_.up = vec4(Vec3(camera.up() / projection(1, 1)), 0.0F);
  block_.viewport = Vec4(width, height, 1.0F / width, 1.0F / height);
  glBindBuffer(GL_UNIFORM_BUFFER, gl_->frame.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(FrameBlock), &block_, GL_DYNAMIC_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, gl_->frame.id());
}

Image RasterRenderer::render(const Camera& camera, const FrameInfo&) {
  context_->make_current();
  std::optional<Targets>& targets = gl_->targets;
  if (!targets || targets->width() != camera.width() || targets->height() != camera.height()) {
    targets.reset();
    targets.emplace(camera.width(), camera.height(), raster_.multisample);
  }
  if (lights_are_stale_) gl_->maps.fit(scene_, positions_, block_);
  upload_frame(camera);
  gl_->maps.bind_textures();
  if (lights_are_stale_) gl_->maps.draw(gl_->meshes);
  lights_are_stale_ = false;

  Image image(camera.width(), camera.height());
  draw_color();
  targets->read_color(image);
  if (std::find(settings_.channels.begin(), settings_.channels.end(), "depth") != settings_.channels.end()) {
    draw_depth();
    targets->read_depth(image);
  }
  check_gl("drawing a frame");
  return image;
}

/// Background first, because the ground's edge lets it through; the ground last, for it is the most of the
/// picture and hidden by the rest.
void RasterRenderer::draw_color() {
  const Programs& programs = gl_->programs;
  gl_->targets->begin_color();
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  programs.background.use();
  glBindVertexArray(gl_->no_attributes.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);

  glEnable(GL_DEPTH_TEST);
  programs.mesh.use();
  for (const MeshBuffers& mesh : gl_->meshes) {
    mesh.closed() ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
    set_material(programs.mesh, mesh.material());
    glUniform1i(programs.mesh.location("is_smooth"), mesh.smooth() ? 1 : 0);
    mesh.draw();
  }

  glBindVertexArray(gl_->no_attributes.id());
  glEnable(GL_CULL_FACE);
  programs.emitter.use();
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    if (!scene_.lights[i].visible) continue;
    glUniform1i(programs.emitter.location("light"), static_cast<GLint>(i));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  if (!scene_.ground.enabled) return;
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  programs.ground.use();
  set_material(programs.ground, scene_.ground.material);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDisable(GL_BLEND);
}

void RasterRenderer::draw_depth() {
  const Programs& programs = gl_->programs;
  gl_->targets->begin_depth();
  glEnable(GL_DEPTH_TEST);
  programs.mesh_depth.use();
  for (const MeshBuffers& mesh : gl_->meshes) {
    mesh.closed() ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
    mesh.draw();
  }
  if (!scene_.ground.enabled) return;
  glDisable(GL_CULL_FACE);
  programs.ground_depth.use();
  glBindVertexArray(gl_->no_attributes.id());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

std::string RasterRenderer::description() const {
  context_->make_current();
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  return context_->platform() + ", " + text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace

std::unique_ptr<Renderer> make_raster_renderer(const RenderSettings& settings, int threads) {
  return std::make_unique<RasterRenderer>(settings, threads);
}

}  // namespace lagomorph::render
