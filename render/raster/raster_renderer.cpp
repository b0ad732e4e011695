#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/backends.h"
#include "render/error.h"
#include "render/ground_texture.h"
#include "render/raster/data_pass.h"
#include "render/raster/frame_block.h"
#include "render/raster/gl_context.h"
#include "render/raster/gl_objects.h"
#include "render/raster/ground_tiles.h"
#include "render/raster/light_maps.h"
#include "render/raster/lit_pixels.h"
#include "render/raster/mesh_buffers.h"
#include "render/raster/optics_stand_in.h"
#include "render/raster/pixel_ray.h"
#include "render/raster/programs.h"
#include "render/raster/ray_pass.h"
#include "render/raster/ray_scene.h"
#include "render/raster/shaders/shaders.h"
#include "render/raster/sky_model.h"
#include "render/raster/stand_ins.h"
#include "render/raster/still_picture.h"
#include "render/raster/supersampled.h"
#include "render/raster/tables.h"
#include "render/raster/targets.h"
#include "render/raster/view_range.h"

namespace lagomorph::render {
namespace {

using namespace raster;

constexpr int sheen_table_size = 64;
constexpr int most_peels = 256;  // surfaces that are not opaque, one behind the other

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
      : settings_(settings),
        raster_(settings.raster),
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
  void update_colors(int mesh, std::span<const Color> colors) override;
  void set_previous(int mesh, std::span<const Vec3> positions) override;
  Image render(const Camera&, const FrameInfo&) override;
  double seconds_reading_back() const override { return seconds_reading_; }
  std::string description() const override;

private:
  /// All that lives in the context.
  struct GlSide {
    explicit GlSide(const RasterSettings& settings) : maps(settings) {}
    LightFeatures features;
    std::optional<Programs> programs;  // for these, from the first scene on
    LightMaps maps;
    std::optional<StillPicture> still;
    Buffer frame, surfaces;
    std::optional<Texture> sheen_table;  // used where a mesh has sheen
    VertexArray no_attributes;
    std::vector<MeshBuffers> meshes;
    std::optional<Targets> targets;
    std::optional<Program> mesh_number;   // compiled when it is asked for
    std::optional<Program> alpha;         // likewise
    std::optional<DataPass> data;         // likewise
    std::optional<SeenPrograms> colored;  // likewise; used where a mesh has colours of its vertices
    std::optional<PeelPrograms> peel;     // used where a mesh is not opaque
    std::optional<RayScene> rays;         // used where meshes are clear or the ground mirrors them
    bool peel_has_colors = false;
    bool has_colors = false;

    const SeenPrograms& seen() const { return has_colors ? *colored : programs->seen; }
  };

  void check_mesh_number(int mesh) const;
  void make_programs();
  void upload_surfaces(const RenderScene&);
  void upload_sheens(const RenderScene&, std::vector<SurfaceBlock>&);
  Mat4 upload_frame(const Camera&, const Camera& before);
  void show_ground(bool shown);
  void draw_full_screen() const;
  void draw_ground(const Program&) const;
  /// Solid ones are those that are opaque and not clear.
  enum class Which { all, opaque, solid, see_through };
  void draw_meshes(const Program&, Which which = Which::all) const;
  bool ground_hides(const Camera&) const;
  void draw_seen(bool behind_ground, Which) const;
  void draw_bodies(const Camera&, Which, const PixelRectangle& seen);
  void draw_with_rays(const Camera&, const PixelRectangle& seen, std::span<float> color);
  bool any_clear() const {
    return std::any_of(gl_->meshes.begin(), gl_->meshes.end(),
                       [](const MeshBuffers& m) { return m.clear(); });
  }
  bool ground_mirrors_by_rays() const { return mirrors_by_rays(scene_.ground) && !catches_shadows(); }
  void put_background(const PixelRectangle& drawn, std::span<float> color);
  void catch_shadows(const StillParts&, const PixelRectangle& drawn, std::span<float> color);
  struct LayerPass {
    const Program &surface, &layer;
    GLenum weight_of_drawn;
    bool peeled;
  };
  void draw_layers(const PixelRectangle& seen, const LayerPass&);
  void draw_see_through(const PixelRectangle& seen);
  void draw_depth() const;
  void draw_body_ids(Image&);
  void draw_alpha(Image&);
  void draw_data(Image&, const Mat4& clip_before);
  bool wants(const char* channel) const {
    return std::find(settings_.channels.begin(), settings_.channels.end(), channel) !=
           settings_.channels.end();
  }

  bool catches_shadows() const { return scene_.ground.enabled && scene_.ground.shadow_catcher; }
  bool draws_alpha() const { return settings_.transparent || wants(alpha_channel); }

  RenderSettings settings_;
  RasterSettings raster_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<GlSide> gl_;
  RenderScene scene_;                         // but for the meshes
  std::vector<std::vector<Vec3>> positions_;  // of each mesh
  std::vector<int> body_ids_;                 // of each mesh
  FrameBlock block_{};
  std::vector<SurfaceTexel> surfaces_;  // the first layer's
  LitPixels lit_;                       // likewise
  std::vector<float> caught_;           // alpha of the ground as a shadow catcher, rows from the top
  bool lights_are_stale_ = true;
  double seconds_reading_ = 0.0;  // of all targets
  bool has_ground_ = false;       // the scene; scene_ has it where it is drawn
};

SurfaceBlock surface_block(const Material& material, float thickness, ByRays by_rays) {
  const Material m = optics_stand_in(material, thickness, by_rays);
  const float r = (m.ior - 1.0F) / (m.ior + 1.0F);
  const bool mirrors = !by_rays.mirrored || material.coat > 0.0F;  // the coat is another mirror
  return {vec4(m.base_color, mirrors ? 0.0F : -1.0F), Vec4(m.roughness, m.metallic, r * r, m.opacity),
          vec4(Color(m.sheen * m.sheen_tint), 0.5F)};
}

void RasterRenderer::set_scene(const RenderScene& scene) {
  check_scene(scene);
  context_->make_current();
  scene_ = with_stand_ins(scene);
  if (settings_.transparent) scene_.background = Color::Zero();
  scene_.ground.shadow_catcher = scene_.ground.shadow_catcher && settings_.transparent;
  has_ground_ = scene_.ground.enabled;
  positions_.clear();
  body_ids_.clear();
  gl_->meshes.clear();
  for (const Mesh& mesh : scene.meshes) {
    gl_->meshes.emplace_back(mesh, drawn_by_rays(scene, mesh).behind);
    positions_.push_back(mesh.positions);
    body_ids_.push_back(mesh.body_id);
  }
  gl_->has_colors = std::any_of(gl_->meshes.begin(), gl_->meshes.end(),
                                [](const MeshBuffers& mesh) { return mesh.colored(); });
  gl_->rays.reset();
  if (mirrors_by_rays(scene.ground) ||
      std::any_of(scene.meshes.begin(), scene.meshes.end(),
                  [&](const Mesh& mesh) { return drawn_by_rays(scene, mesh).any(); }))
    gl_->rays.emplace(scene, scene_);
  make_programs();
  const int lights = static_cast<int>(scene_.lights.size());
  if (!gl_->still || !gl_->still->is_for(gl_->features, lights)) {
    gl_->still.reset();
    gl_->still.emplace(gl_->features, lights);
  }
  upload_surfaces(scene);
  gl_->maps.set_scene(scene, scene_, gl_->features, block_);
  lights_are_stale_ = true;
  check_gl("taking the scene");
}

/// Those that the scene needs.
void RasterRenderer::make_programs() {
  const bool sees_suns = !scene_.background && std::any_of(scene_.suns.begin(), scene_.suns.end(),
                                                           [](const Sun& sun) { return sun.visible; });
  const bool see_through = std::any_of(gl_->meshes.begin(), gl_->meshes.end(),
                                       [](const MeshBuffers& mesh) { return mesh.see_through(); });
  const std::vector<std::string> textures = ground_texture_names();
  const auto texture = std::find(textures.begin(), textures.end(), scene_.ground.texture) - textures.begin();
  const bool sheen = std::any_of(gl_->meshes.begin(), gl_->meshes.end(),
                                 [](const MeshBuffers& mesh) { return mesh.material().sheen > 0.0F; });
  const LightFeatures features{scene_.sky.map != nullptr, sees_suns, see_through, sheen,
                               static_cast<int>(texture)};
  if (!gl_->programs || !(features == gl_->features)) {
    gl_->features = features;
    gl_->programs.reset();
    gl_->programs.emplace(raster_.multisample, features);
    gl_->colored.reset();
    gl_->peel.reset();
    gl_->alpha.reset();
    gl_->data.reset();
  }
  if (gl_->has_colors && !gl_->colored) gl_->colored.emplace(raster_.multisample, true, features);
  if (see_through && (!gl_->peel || gl_->peel_has_colors != gl_->has_colors)) {
    gl_->peel.reset();
    gl_->peel.emplace(raster_.multisample, gl_->has_colors, features);
    gl_->peel_has_colors = gl_->has_colors;
  }
}

/// The ground, the meshes, the lights.
void RasterRenderer::upload_surfaces(const RenderScene& scene) {
  std::vector<SurfaceBlock> surfaces = {surface_block(scene.ground.material, 1.0F, ByRays{})};
  for (const Mesh& mesh : scene.meshes) {
    surfaces.push_back(
        surface_block(mesh.material, mean_chord(mesh.positions, mesh.triangles), drawn_by_rays(scene, mesh)));
  }
  for (const AreaLight& light : scene_.lights)
    surfaces.push_back({vec4(Color(light.radiance * light.color), 1.0F), Vec4::Zero(), Vec4::Zero()});
  if (gl_->features.sheen) upload_sheens(scene, surfaces);
  gl_->still->set_ground(surfaces.front());
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, gl_->surfaces.id());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(surfaces.size() * sizeof(SurfaceBlock)),
               surfaces.data(), GL_STATIC_DRAW);
}

/// A row of their table each, which the meshes' surfaces, from the second on, are told.
void RasterRenderer::upload_sheens(const RenderScene& scene, std::vector<SurfaceBlock>& surfaces) {
  std::vector<float> roughnesses;
  for (const Mesh& mesh : scene.meshes) roughnesses.push_back(mesh.material.sheen_roughness);
  const auto rows = static_cast<int>(roughnesses.size());
  for (int k = 0; k < rows; ++k)
    surfaces[static_cast<std::size_t>(k) + 1].sheen.w() =
        (static_cast<float>(k) + 0.5F) / static_cast<float>(rows);
  gl_->sheen_table.emplace();
  allocate_table(*gl_->sheen_table, sheen_table_size, rows, sheen_table(roughnesses, sheen_table_size));
}

void RasterRenderer::check_mesh_number(int mesh) const {
  if (mesh >= 0 && static_cast<std::size_t>(mesh) < positions_.size()) return;
  throw SettingsError("mesh " + std::to_string(mesh) + " is not one of the scene's " +
                      std::to_string(positions_.size()));
}

void RasterRenderer::update_colors(int mesh, std::span<const Color> colors) {
  check_mesh_number(mesh);
  MeshBuffers& buffers = gl_->meshes[static_cast<std::size_t>(mesh)];
  check_colors("mesh " + std::to_string(mesh),
               buffers.colored() ? positions_[static_cast<std::size_t>(mesh)].size() : 0, colors);
  context_->make_current();
  buffers.upload(colors);
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
  gl_->meshes[static_cast<std::size_t>(mesh)].upload(current);
  if (gl_->rays) gl_->rays->geometry().move(mesh, current);
  lights_are_stale_ = true;
}

void RasterRenderer::set_previous(int mesh, std::span<const Vec3> positions) {
  check_mesh_number(mesh);
  context_->make_current();
  gl_->meshes[static_cast<std::size_t>(mesh)].upload_previous(positions);
}

/// World to clip of the camera before.
Mat4 RasterRenderer::upload_frame(const Camera& camera, const Camera& before) {
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
  if (scene_.sky.map && !camera.is_orthographic()) {
    const float texels = 2.0F * block_.up.norm() / height * static_cast<float>(scene_.sky.map->height()) /
                         std::numbers::pi_v<float>;  // in a pixel
    block_.sky_picture.y() = std::max(std::log2(texels), 0.0F);
  }
  glBindBuffer(GL_UNIFORM_BUFFER, gl_->frame.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(FrameBlock), &block_, GL_DYNAMIC_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, gl_->frame.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, gl_->surfaces.id());
  return before.projection(range.near, range.far) * before.view();
}

void RasterRenderer::show_ground(bool shown) {
  if (shown == scene_.ground.enabled) return;
  scene_.ground.enabled = shown;
  gl_->maps.show_ground(shown, block_);
  if (gl_->rays) gl_->rays->geometry().show_ground(shown);
  gl_->still->forget();
  lights_are_stale_ = true;
}

Image RasterRenderer::render(const Camera& camera, const FrameInfo& frame) {
  context_->make_current();
  show_ground(has_ground_ && !frame.leaves_out_ground);
  std::optional<Targets>& targets = gl_->targets;
  if (!targets || targets->width() != camera.width() || targets->height() != camera.height() ||
      targets->colors() != gl_->has_colors) {
    targets.reset();
    targets.emplace(camera.width(), camera.height(), raster_.multisample, gl_->has_colors);
  }
  const double read_before = targets->seconds_reading();
  if (lights_are_stale_) gl_->maps.fit(scene_, positions_, gl_->meshes, block_);
  const Mat4 clip_before =
      upload_frame(camera, frame.camera_before != nullptr ? *frame.camera_before : camera);
  gl_->maps.bind_textures();
  if (gl_->features.sheen) {
    glActiveTexture(GL_TEXTURE3);
    glBindTexture(GL_TEXTURE_2D, gl_->sheen_table->id());
  }
  if (lights_are_stale_) gl_->maps.draw(gl_->meshes, positions_, block_);
  lights_are_stale_ = false;

  Image image(camera.width(), camera.height());
  const PixelRectangle picture = {0, 0, camera.width(), camera.height()};
  const PixelRectangle drawn =
      frame.region && !gl_->rays  // rays end anywhere
          ? common_rectangle(with_neighbours(rectangle_of(*frame.region, camera.height())), picture)
          : picture;
  if (draws_alpha()) {  // of all pixels
    targets->bind_seen();
    targets->clear_seen();
  }
  const PixelRectangle wanted = common_rectangle(seen_rectangle(camera, positions_, scene_), drawn);
  const PixelRectangle seen = common_rectangle(whole_blocks(wanted), picture);
  std::vector<float>& color = image.add(color_channel, 3);
  put_background(drawn, color);
  if (gl_->rays) {
    draw_with_rays(camera, seen, color);
  } else {
    draw_bodies(camera, Which::opaque, seen);
    targets->put_over(color);
  }
  if (wants(depth_channel)) {
    draw_depth();
    targets->read_values(image.add(depth_channel, 1));
  }
  if (wants(body_id_channel)) draw_body_ids(image);
  if (draws_alpha()) draw_alpha(image);
  const std::size_t channels = image.channels().size();
  for (const char* channel :
       {normal_channel, albedo_channel, position_channel, motion_channel, triangle_id_channel}) {
    if (wants(channel)) image.add(channel, channel_kind(channel).components);
  }
  if (image.channels().size() > channels) draw_data(image, clip_before);
  seconds_reading_ += targets->seconds_reading() - read_before;
  check_gl("drawing a frame");
  return image;
}

/// Into what is read to be put over the picture.
void RasterRenderer::draw_bodies(const Camera& camera, Which which, const PixelRectangle& seen) {
  Targets& targets = *gl_->targets;
  glScissor(seen.x, seen.y, seen.width, seen.height);
  glEnable(GL_SCISSOR_TEST);
  targets.bind_color();
  constexpr std::array<float, 4> nothing = {};
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  draw_seen(ground_hides(camera), which);
  targets.bind_seen_textures();
  draw_layers(seen, {gl_->programs->surface, gl_->seen().layer, GL_ONE_MINUS_SRC_ALPHA, false});
  if (gl_->features.see_through) draw_see_through(seen);
  glDisable(GL_SCISSOR_TEST);
  targets.read_color(seen);
}

/// Bodies over the picture, which is the background, what the ground mirrors of them and what is seen through
/// them.
void RasterRenderer::draw_with_rays(const Camera& camera, const PixelRectangle& seen,
                                    std::span<float> color) {
  gl_->rays->geometry().commit();
  std::vector<float> still(color.begin(), color.end()), solid;
  DrawnPictures pictures{still, still, {}};
  std::vector<SurfaceTexel> surfaces;
  const bool all_are_clear = std::all_of(gl_->meshes.begin(), gl_->meshes.end(),
                                         [](const MeshBuffers& mesh) { return mesh.clear(); });
  if (!all_are_clear) {
    draw_bodies(camera, Which::solid, seen);
    solid = still;
    gl_->targets->put_over(solid);
    surfaces = surfaces_;
    pictures.solid = solid;
    pictures.surfaces = {whole_blocks(seen), surfaces};
  }
  if (ground_mirrors_by_rays()) {
    add_mirrored_by_ground(*gl_->rays, camera, pictures, mirrored_rectangle(camera, positions_, scene_),
                           color);
  }
  if (any_clear()) {
    std::copy(color.begin(), color.end(), still.begin());
    draw_bodies(camera, Which::opaque, seen);
  }
  gl_->targets->put_over(color);
  add_by_rays(*gl_->rays, camera, pictures, seen, color);
}

void RasterRenderer::draw_full_screen() const {
  glBindVertexArray(gl_->no_attributes.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void RasterRenderer::draw_ground(const Program& program) const {
  program.use();
  glDisable(GL_CULL_FACE);
  glBindVertexArray(gl_->no_attributes.id());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void RasterRenderer::draw_meshes(const Program& program, Which which) const {
  program.use();
  GLuint surface = 1;
  for (const MeshBuffers& mesh : gl_->meshes) {
    const GLuint number = surface++;
    if (which != Which::all && mesh.see_through() != (which == Which::see_through)) continue;
    if (which == Which::solid && mesh.clear()) continue;
    mesh.closed() && which != Which::see_through ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
    glUniform1ui(program.location("surface"), number);
    glUniform1i(program.location("is_smooth"), mesh.smooth() ? 1 : 0);
    glUniform1i(program.location("is_colored"), mesh.colored() ? 1 : 0);
    glUniform1i(program.location("moves"), mesh.moves() ? 1 : 0);
    mesh.draw();
  }
}

/// Whether something may be behind the ground.
bool RasterRenderer::ground_hides(const Camera& camera) const {
  const float height = scene_.ground.height;
  if (!scene_.ground.enabled) return false;
  if (camera.is_orthographic() || camera.position().y() <= height) return true;
  return std::any_of(positions_.begin(), positions_.end(), [&](const std::vector<Vec3>& mesh) {
    return std::any_of(mesh.begin(), mesh.end(), [&](const Vec3& p) { return p.y() < height; });
  });
}

/// What is seen of meshes and visible lights, unlit, in every sample.
void RasterRenderer::draw_seen(bool behind_ground, Which which) const {
  const Programs& programs = *gl_->programs;
  gl_->targets->bind_seen();
  glEnable(GL_DEPTH_TEST);
  gl_->targets->clear_seen();
  if (behind_ground) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_ground(programs.ground_cover);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  draw_meshes(gl_->seen().mesh, which);
  const Program& light = gl_->seen().light;
  light.use();
  glEnable(GL_CULL_FACE);
  glBindVertexArray(gl_->no_attributes.id());
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    if (!scene_.lights[i].visible) continue;
    glUniform1i(light.location("light"), static_cast<GLint>(i));
    glUniform1ui(light.location("surface"), static_cast<GLuint>(1 + gl_->meshes.size() + i));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
}

/// The background and the ground over it.
void RasterRenderer::put_background(const PixelRectangle& drawn, std::span<float> color) {
  const std::vector<TileRun> tiles = touched_tiles(block_, gl_->maps.casters(), gl_->maps.least_map(), drawn);
  const StillParts& still = gl_->still->draw(block_, tiles);
  light_ground(block_, gl_->maps.depths(), tiles, lit_);
  copy_less_taken(block_, still, gl_->maps.ground_seen(), tiles, lit_, drawn, ground_mirrors_by_rays(),
                  color);
  if (catches_shadows()) catch_shadows(still, drawn, color);
}

/// Of the ground only what is taken of its light is left, as alpha: black is behind its fading edge.
void RasterRenderer::catch_shadows(const StillParts& still, const PixelRectangle& drawn,
                                   std::span<float> color) {
  const auto width = static_cast<std::size_t>(still.width);
  caught_.assign(still.pixels(), 0.0F);
  const auto luminance = [](const float* c) { return 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2]; };
  tbb::parallel_for(drawn.y, drawn.y + drawn.height, [&](int y) {
    for (int x = drawn.x; x < drawn.x + drawn.width; ++x) {
      const std::size_t from_below = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      const std::size_t at =
          static_cast<std::size_t>(still.height - 1 - y) * width + static_cast<std::size_t>(x);
      float* const left = color.data() + 3 * at;
      const float all = luminance(still.picture.data() + 3 * from_below), reached = luminance(left);
      std::fill_n(left, 3, 0.0F);
      const auto ground = ground_at_pixel(block_, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      if (!ground || !(all > 0.0F)) continue;
      const float there = 1.0F - ground_fade(scene_.ground, ground->point);
      caught_[at] = there * std::clamp(1.0F - reached / all, 0.0F, 1.0F);
    }
  });
}

/// The bound samples that are seen, lit once a pixel and surface, into the picture or that of the peeled
/// surfaces: layers add up, by what `weight_of_drawn` leaves of those before; where that is their cover, the
/// first covers for all.
void RasterRenderer::draw_layers(const PixelRectangle& seen, const LayerPass& pass) {
  Targets& targets = *gl_->targets;
  const PixelRectangle blocks = whole_blocks(seen);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  targets.bind_surface();
  pass.surface.use();
  draw_full_screen();
  glDepthFunc(GL_LESS);
  targets.read_surface(blocks, surfaces_);
  if (!light_surfaces(block_, gl_->maps.depths(), blocks, surfaces_, lit_)) return;
  targets.take(lit_);
  targets.bind_surface_texture();
  pass.peeled ? targets.bind_peeled_color() : targets.bind_color();
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, pass.weight_of_drawn);
  pass.layer.use();
  for (int i = 0; i < raster_.multisample; ++i) {
    glUniform1i(pass.layer.location("layer"), i);
    draw_full_screen();
  }
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

/// What is not opaque: surface behind surface as far as there are any, each by what those before it let
/// through. So the order in which they are drawn does not matter.
void RasterRenderer::draw_see_through(const PixelRectangle& seen) {
  Targets& targets = *gl_->targets;
  const PeelPrograms& programs = *gl_->peel;
  targets.need_peels();
  targets.bind_peeled_color();
  constexpr std::array<float, 4> nothing = {};
  glDisable(GL_SCISSOR_TEST);
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  glEnable(GL_SCISSOR_TEST);
  const Query query;
  for (int peel = 0; peel < most_peels; ++peel) {
    targets.begin_peel(peel % 2);
    glEnable(GL_DEPTH_TEST);
    programs.mesh.use();
    glUniform1i(programs.mesh.location("is_first"), peel == 0 ? 1 : 0);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, query.id());
    draw_meshes(programs.mesh, Which::see_through);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    GLuint any = 0;
    glGetQueryObjectuiv(query.id(), GL_QUERY_RESULT, &any);
    if (any == 0) break;
    targets.bind_peeled_textures(peel % 2);
    draw_layers(seen, {programs.surface, programs.layer, GL_ONE, true});
  }
  targets.bind_color();
  targets.bind_peeled_color_texture();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  programs.composite.use();
  draw_full_screen();
  glDisable(GL_BLEND);
}

/// One sample a pixel, so that a depth is that of the surface at the pixel's centre.
void RasterRenderer::draw_depth() const {
  const Programs& programs = *gl_->programs;
  gl_->targets->bind_depth();
  glEnable(GL_DEPTH_TEST);
  const std::array<float, 4> nothing = {std::numeric_limits<float>::infinity(), 0.0F, 0.0F, 0.0F};
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  glClear(GL_DEPTH_BUFFER_BIT);
  draw_meshes(programs.mesh_depth);
  if (!scene_.ground.enabled) return;
  draw_ground(programs.ground_depth);
}

/// The meshes' numbers from 1 on; the ground hides them and has none.
void RasterRenderer::draw_body_ids(Image& image) {
  if (!gl_->mesh_number) {
    using Parts = std::initializer_list<const char*>;
    gl_->mesh_number.emplace("mesh number", Parts{shaders::frame, shaders::mesh_vertex},
                             Parts{shaders::frame, shaders::mesh_number_fragment});
  }
  gl_->targets->bind_depth();
  glEnable(GL_DEPTH_TEST);
  constexpr std::array<float, 4> nothing = {};
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  glClear(GL_DEPTH_BUFFER_BIT);
  if (scene_.ground.enabled) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_ground(gl_->programs->ground_depth);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  draw_meshes(*gl_->mesh_number);
  std::vector<float>& ids = image.add(body_id_channel, 1);
  gl_->targets->read_values(ids);
  for (float& id : ids)
    id = id > 0.0F ? static_cast<float>(body_ids_[static_cast<std::size_t>(id) - 1]) : -1.0F;
}

/// Of the samples that say what is seen.
void RasterRenderer::draw_alpha(Image& image) {
  if (!gl_->alpha) {
    using Parts = std::initializer_list<const char*>;
    const std::string samples = "#define SAMPLES " + std::to_string(raster_.multisample) + "\n" +
                                (gl_->features.see_through ? "#define PEEL\n" : "");
    gl_->alpha.emplace(
        "alpha", Parts{shaders::full_screen_vertex},
        Parts{samples.c_str(), shaders::frame, shaders::ground_point, shaders::alpha_fragment});
  }
  gl_->targets->bind_depth();
  gl_->targets->bind_seen_textures();
  if (gl_->features.see_through) gl_->targets->bind_peeled_color_texture();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  gl_->alpha->use();
  glUniform1i(gl_->alpha->location("catches_shadows"), catches_shadows() ? 1 : 0);
  draw_full_screen();
  std::vector<float>& alpha = image.add(alpha_channel, 1);
  gl_->targets->read_values(alpha);
  if (!catches_shadows()) return;
  for (std::size_t i = 0; i < alpha.size(); ++i) alpha[i] += (1.0F - alpha[i]) * caught_[i];
}

/// Those of DataPass's channels that the image has.
void RasterRenderer::draw_data(Image& image, const Mat4& clip_before) {
  std::optional<DataPass>& data = gl_->data;
  if (!data || data->width() != image.width() || data->height() != image.height() ||
      data->colors() != gl_->has_colors) {
    data.reset();
    data.emplace(image.width(), image.height(), gl_->has_colors, gl_->features);
  }
  data->begin(clip_before);
  if (scene_.ground.enabled) {
    draw_ground(data->ground());
  }
  draw_meshes(data->mesh());
  data->read(image);
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
