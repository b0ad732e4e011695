#include "render/raster/light_maps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "render/albedo.h"
#include "render/raster/caster_depths.h"
#include "render/raster/light_view.h"
#include "render/raster/shaders/shaders.h"
#include "render/raster/sky_light.h"
#include "render/raster/sky_model.h"
#include "render/raster/stand_ins.h"
#include "render/raster/tables.h"

namespace lagomorph::render::raster {
namespace {

constexpr int sky_map_size = 256;
constexpr int ground_map_size = 128;
constexpr int bounce_map_size = ground_map_size / 2;
constexpr float search_taps = 16.0F;  // of each of a quad's pixels
constexpr float least_taps = 8.0F;    // of each part of a light
constexpr int least_map_size = 256;
constexpr int sky_table_size = 64;
constexpr int coat_table_size = 32;
constexpr int widest_sky_picture = 8192;  // 512 MB with its levels

/// A level each.
void allocate_cubes(const Texture& texture, std::span<const CubeMap<Vec4>> levels) {
  glBindTexture(GL_TEXTURE_CUBE_MAP, texture.id());
  glTexStorage2D(GL_TEXTURE_CUBE_MAP, static_cast<GLsizei>(levels.size()), GL_RGBA32F, levels[0].size(),
                 levels[0].size());
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const int size = levels[level].size();
    for (int face = 0; face < 6; ++face) {
      glTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), static_cast<GLint>(level),
                      0, 0, size, size, GL_RGBA, GL_FLOAT, levels[level].at(face, 0, 0).data());
    }
  }
  sampling(GL_TEXTURE_CUBE_MAP, levels.size() > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR, GL_LINEAR);
}

/// Half floats, which end at 65504.
void allocate_picture(const Texture& texture, const SkyMap& map) {
  std::vector<Color> texels = map.texels();
  for (Color& texel : texels) texel = texel.min(65504.0F);
  const int levels = std::bit_width(static_cast<unsigned>(std::max(map.width(), map.height())));
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexStorage2D(GL_TEXTURE_2D, levels, GL_RGB16F, map.width(), map.height());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, map.width(), map.height(), GL_RGB, GL_FLOAT, texels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  sampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
}

/// The sphere around all positions, on a grid of a sixteenth of its size or so, see fit_light_view().
struct Sphere {
  Vec3 center = Vec3::Zero();
  float radius = 1.0F;
};
Sphere bounding_sphere(std::span<const std::vector<Vec3>> positions, const Eigen::AlignedBox3f& box) {
  if (box.isEmpty()) return {};
  const float step = std::exp2(std::ceil(std::log2(std::max(box.diagonal().norm(), 1e-4F))) - 5.0F);
  Sphere sphere;
  sphere.center = step * (box.center() / step).array().round().matrix();
  float radius = 0.0F;
  for (const std::vector<Vec3>& mesh : positions) {
    for (const Vec3& p : mesh) radius = std::max(radius, (p - sphere.center).squaredNorm());
  }
  sphere.radius = step * std::ceil(std::sqrt(radius) / step + 0.1F);
  return sphere;
}

/// The mean albedo of what hides the sky from the ground.
Color hiding_albedo(const RenderScene& scene, std::span<const ByRays> by_rays) {
  Color sum = Color::Zero();
  float weights = 1e-6F;
  for (std::size_t k = 0; k < scene.meshes.size(); ++k) {
    const Mesh& mesh = scene.meshes[k];
    const float weight = opacity_to_light(mesh, by_rays[k].behind);
    sum += weight * albedo(mesh.material);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

LightMaps::LightMaps(const RasterSettings& settings)
    : settings_(settings), ground_lit_texture_(GL_TEXTURE1, ground_map_size, ground_map_size) {
  allocate_table(sky_table_, sky_table_size, 1, sky_irradiance_table(sky_table_size));
  allocate_table(coat_table_, coat_table_size, coat_table_size, coat_albedo_table(coat_table_size));
  const int levels = static_cast<int>(std::log2(bounce_map_size)) + 1;
  glBindTexture(GL_TEXTURE_2D, ground_bounce_.id());
  glTexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA16F, bounce_map_size, bounce_map_size);
  sampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, ground_target_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, ground_bounce_.id(), 0);
  check_framebuffer("ground map");
}

/// The light of the scene's map, and what is seen itself where the camera may see it.
void LightMaps::set_sky_map(const RenderScene& scene, const SkyMap& seen, FrameBlock& block) {
  const SkyLight light = sky_light(scene.sky);
  block.sky = light.directions;
  sky_textures_.emplace();
  allocate_cubes(sky_textures_->irradiance_above, {&light.irradiance_above, 1});
  allocate_cubes(sky_textures_->radiance_below, {&light.radiance_below, 1});
  allocate_cubes(sky_textures_->lobes_above, light.lobes_above);
  allocate_cubes(sky_textures_->lobes_below, light.lobes_below);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  block.sky_picture = Vec4(seen.turn(), 0.0F, scene.sky.strength, 0.0F);
  if (!scene.background) allocate_picture(sky_textures_->picture, reduced(seen, widest_sky_picture));
  check_gl("the sky's map");
}

void LightMaps::set_scene(const RenderScene& given, const RenderScene& scene, const DrawnByRays& by_rays,
                          const LightFeatures& features, FrameBlock& block) {
  if (!ground_program_ || !(features == features_)) {
    features_ = features;
    using Parts = Program::Parts;
    ground_program_.reset();
    ground_program_.emplace("ground map", Parts{shaders::full_screen_vertex},
                            Parts{features.definitions().c_str(), shaders::frame, shaders::brdf, shaders::sky,
                                  shaders::ground_color, shaders::ground_map_fragment});
  }
  splits_.assign(scene.lights.size(), {});
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const AreaLight& light = scene.lights[i];
    const LightFrame frame = light_frame(light);
    LightBlock& b = block.lights[i];
    b.position = vec4(light.position, 1.0F);
    b.right = vec4(frame.right, 0.5F * light.size.x());
    b.up = vec4(frame.up, 0.5F * light.size.y());
    const std::size_t first_sun = scene.lights.size() - scene.suns.size();
    b.normal = vec4(frame.normal, i < first_sun ? 0.0F : solid_angle(scene.suns[i - first_sun]));
    splits_[i] = i < first_sun ? split_of(light, given.meshes, scene.ground) : split_of_sun(b.normal.w());
    const bool disc = features.sun_discs && i >= first_sun && scene.suns[i - first_sun].visible;
    b.radiance = vec4(Color(light.color * light.radiance), disc ? 1.0F : 0.0F);
  }
  if (scene.sky.map) {
    set_sky_map(scene, *given.sky.map, block);
  } else {
    sky_textures_.reset();
    block.sky = sky_directions(scene.sky);
    block.sky_picture = Vec4::Zero();
  }
  block.zenith = vec4(Color(scene.sky.strength * scene.sky.zenith), 0.0F);
  block.horizon = vec4(Color(scene.sky.strength * scene.sky.horizon), 0.0F);
  block.background = scene.background ? vec4(*scene.background, 1.0F) : Vec4::Zero();
  block.mesh_albedo = vec4(hiding_albedo(given, by_rays.meshes), 0.0F);
  const Ground& g = scene.ground;
  block.ground = Vec4(g.height, g.radius, g.fade_start, 0.0F);
  show_ground(g.enabled, block);
  block.ground_texture = Vec4(g.texture_size, g.line_width, 0.0F, 0.0F);
  block.texture_color = vec4(g.texture_color, 0.0F);
  block.ground_at = vec4(Vec3(g.center.x(), g.height, g.center.z()), 0.0F);
  block.counts =
      Vec4(static_cast<float>(scene.lights.size()), 0.0F, 0.0F, static_cast<float>(ground_map_size));
}

void LightMaps::show_ground(bool shown, FrameBlock& block) {
  ground_ = shown;
  block.ground.w() = shown ? 1.0F : 0.0F;
}

void LightMaps::fit(const RenderScene& scene, std::span<const std::vector<Vec3>> positions,
                    std::span<const MeshBuffers> meshes, FrameBlock& block) {
  views_.clear();
  depths_.lights.clear();
  depths_.parts.clear();
  least_map_ = settings_.shadow_map;
  casters_.assign(scene.lights.size(), {});
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const LightView view = fit_light_view(scene.lights[i], positions, settings_.shadow_map);
    block.lights[i].map = view.map;
    block.lights[i].depth = view.depth;
    put_parts(i, view, light_frame(scene.lights[i]), positions, block.lights[i]);
    for (std::size_t k = 0; k < meshes.size(); ++k)
      add_casters(scene.lights[i], view, positions[k], meshes[k].triangles(), casters_[i]);
  }
  Eigen::AlignedBox3f box;
  for (const std::vector<Vec3>& mesh : positions) {
    for (const Vec3& p : mesh) box.extend(p);
  }
  const Sphere sphere = bounding_sphere(positions, box);
  has_meshes_ = !box.isEmpty();
  block.counts.z() = has_meshes_ ? 1.0F : 0.0F;
  block.sky_map = vec4(sphere.center, 1.0F / sphere.radius);
  const float shadows =
      scene.sky.map ? 2.0F : 1.0F;  // of the meshes' height: those of a bright patch are long
  const float half = 1.5F * sphere.radius + shadows * std::max(sphere.center.y() - scene.ground.height, 0.0F);
  const float scale = 0.5F / half;
  block.ground_map = Vec4(scale, 2.0F * half / static_cast<float>(ground_map_size),
                          0.5F - scale * sphere.center.x(), 0.5F - scale * sphere.center.z());
}

/// What the maps of light i see; `whole` is the view from its middle.
void LightMaps::put_parts(std::size_t i, const LightView& whole, const LightFrame& frame,
                          std::span<const std::vector<Vec3>> positions, const LightBlock& light) {
  const LightSplit& split = splits_[i];
  const auto count = static_cast<std::size_t>(split.count());
  const auto taps = [&](float of_whole) {
    const float each = std::ceil(of_whole / std::sqrt(static_cast<float>(count)));
    return static_cast<int>(std::max(each, std::min(of_whole, least_taps)));
  };
  const int search = taps(search_taps), filter = taps(static_cast<float>(settings_.shadow_samples));
  depths_.lights.push_back({depths_.parts.size(), count, split.below_ground});
  if (count == 1) {
    views_.push_back(whole);
    depths_.parts.push_back({light, whole.size, search, filter, true});
    return;
  }
  // The more there are, the less it takes for all of their texels together to show the same.
  const auto along = static_cast<unsigned>(std::max(split.across, split.up));
  const int size = std::max(settings_.shadow_map / static_cast<int>(std::bit_ceil(along)), least_map_size);
  least_map_ = std::min(least_map_, size);
  for (int k = 0; k < split.count(); ++k) {
    LightBlock part = part_of(light, split, k);
    // The shadow of what is nearer is as wide as the light shines, and the map's depths are finer without.
    const float nearest = 0.5F * std::max(part.right.w(), part.up.w());
    const LightView view = fit_light_view(Vec3(part.position.head<3>()), frame, nearest, positions, size);
    part.map = view.map;
    part.depth = view.depth;
    views_.push_back(view);
    depths_.parts.push_back({part, size, search, filter, false});
  }
}

void LightMaps::draw(std::span<const MeshBuffers> meshes, std::span<const std::vector<Vec3>> positions,
                     const FrameBlock& block) {
  depths_.sky_size = sky_map_size;
  depths_.see_through = std::any_of(meshes.begin(), meshes.end(),
                                    [](const MeshBuffers& mesh) { return mesh.opacity_to_light() < 1.0F; });
  depths_.sky_is_map = features_.sky_map;
  std::vector<Caster> casters;
  casters.reserve(meshes.size());
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const MeshBuffers& mesh = meshes[k];
    casters.push_back(
        {positions[k], mesh.triangles(), mesh.closed(), mesh.opacity_to_light(), mesh.body_id()});
  }
  draw_light_depths(views_, casters, depths_.parts_maps);
  if (has_meshes_) {
    draw_sky_depths(block, casters, sky_map_size, depths_.sky, &depths_.sky_from_below);
  } else {
    depths_.sky.clear();
  }
  if (!ground_) return;
  light_ground_map(block, depths_, ground_lit_);
  ground_lit_texture_.take(ground_lit_);
  ground_seen_ = raster::ground_seen(ground_lit_);
  bind(ground_target_, bounce_map_size, bounce_map_size);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  ground_program_->use();
  glBindVertexArray(no_attributes_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  fill_bounce_levels();
}

/// The means of each level's texels, on the CPU, where a level takes no pass of its own.
void LightMaps::fill_bounce_levels() {
  int size = bounce_map_size;
  bounce_.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  glReadPixels(0, 0, size, size, GL_RGBA, GL_FLOAT, bounce_.data());
  glActiveTexture(GL_TEXTURE4);
  glBindTexture(GL_TEXTURE_2D, ground_bounce_.id());
  for (GLint level = 1; size > 1; ++level) {
    const auto width = static_cast<std::size_t>(size);
    size /= 2;
    std::size_t to = 0;
    for (std::size_t y = 0; y < width; y += 2) {
      for (std::size_t x = 0; x < width; x += 2, ++to) {
        const Vec4* from = bounce_.data() + y * width + x;
        bounce_[to] = 0.25F * (from[0] + from[1] + from[width] + from[width + 1]);
      }
    }
    glTexSubImage2D(GL_TEXTURE_2D, level, 0, 0, size, size, GL_RGBA, GL_FLOAT, bounce_.data());
  }
}

void LightMaps::bind_textures() const {
  const std::pair<GLenum, const Texture*> maps[] = {
      {GL_TEXTURE2, &sky_table_}, {GL_TEXTURE4, &ground_bounce_}, {GL_TEXTURE5, &coat_table_}};
  for (const auto& [unit, map] : maps) {
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, map->id());
  }
  if (!sky_textures_) return;
  const Texture* const cubes[] = {&sky_textures_->irradiance_above, &sky_textures_->radiance_below,
                                  &sky_textures_->lobes_above, &sky_textures_->lobes_below};
  for (GLenum unit = 0; unit < 4; ++unit) {
    glActiveTexture(GL_TEXTURE7 + unit);
    glBindTexture(GL_TEXTURE_CUBE_MAP, cubes[unit]->id());
  }
  glActiveTexture(GL_TEXTURE11);
  glBindTexture(GL_TEXTURE_2D, sky_textures_->picture.id());
}

}  // namespace lagomorph::render::raster
