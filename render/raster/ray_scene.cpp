#include "render/raster/ray_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "render/albedo.h"
#include "render/ground_texture.h"
#include "render/path/dielectric.h"
#include "render/raster/optics_stand_in.h"
#include "render/raster/stand_ins.h"

namespace lagomorph::render::raster {
namespace {

constexpr float least_facing = 0.15F;         // cosine of what the picture shows well enough
constexpr float least_facing_ground = 0.06F;  // likewise of the ground
constexpr std::size_t facing_down = 3;        // of ways to face

Color bilinear(std::span<const float> picture, int width, int height, const Vec2& at) {
  const float x = std::clamp(at.x() - 0.5F, 0.0F, static_cast<float>(width - 1));
  const float y = std::clamp(at.y() - 0.5F, 0.0F, static_cast<float>(height - 1));
  const int x0 = std::min(static_cast<int>(x), std::max(width - 2, 0));
  const int y0 = std::min(static_cast<int>(y), std::max(height - 2, 0));
  const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
  const auto texel = [&](int i, int j) {
    const auto k = 3 * (static_cast<std::size_t>(std::min(j, height - 1)) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(std::min(i, width - 1)));
    return Color(picture[k], picture[k + 1], picture[k + 2]);
  };
  const Color low = (1.0F - u) * texel(x0, y0) + u * texel(x0 + 1, y0);
  const Color high = (1.0F - u) * texel(x0, y0 + 1) + u * texel(x0 + 1, y0 + 1);
  return (1.0F - v) * low + v * high;
}

/// Where the camera sees a point; none outside of the picture.
std::optional<Vec2> place_in(const Camera& camera, const Vec3& point) {
  if (!camera.is_orthographic() && camera.depth(point) <= 0.0F) return std::nullopt;
  const Vec2 at = camera.project(point);
  if (at.x() < 0.0F || at.y() < 0.0F || at.x() > static_cast<float>(camera.width()) ||
      at.y() > static_cast<float>(camera.height()))
    return std::nullopt;
  return at;
}

/// Of the ways to face, the one along an axis that is on a direction's side.
std::size_t facing(int axis, const Vec3& direction) {
  return 2 * static_cast<std::size_t>(axis) + (direction[axis] < 0.0F ? 1 : 0);
}

/// Irradiance from the sky above the horizon, and below it from an open ground that the same sky lights, on
/// six ways to face.
std::array<Color, 6> ambient_light(const Sky& sky, const Ground& ground) {
  constexpr int count = 512;
  std::array<Color, 6> sums;
  sums.fill(Color::Zero());
  std::array<Color, 6> below = sums;
  for (int k = 0; k < count; ++k) {
    const double y = 1.0 - (2.0 * k + 1.0) / count, turn = 0.61803398874989485 * k;
    const double across = std::sqrt(1.0 - y * y), phi = 2.0 * std::numbers::pi * (turn - std::floor(turn));
    const Vec3 d(static_cast<float>(across * std::cos(phi)), static_cast<float>(y),
                 static_cast<float>(across * std::sin(phi)));
    const bool of_ground = ground.enabled && d.y() < 0.0F;
    const Color light = of_ground ? Color::Zero() : sky_radiance(sky, d);
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = facing(axis, d);
      const float weight = std::abs(d[axis]) * 4.0F * std::numbers::pi_v<float> / count;
      sums[at] += weight * light;
      if (of_ground) below[at] += Color::Constant(weight);
    }
  }
  const Color ground_radiance = std::numbers::inv_pi_v<float> * ground.material.base_color * sums[2];
  for (std::size_t k = 0; k < 6; ++k) sums[k] += below[k] * ground_radiance;
  return sums;
}

/// Irradiance inside of a half clear surface, of the mean outside: what comes through and is sent to and fro
/// by its inner side and base. Over n², by which radiance is less outside.
Color lit_within(const Material& m, float thickness) {
  constexpr int steps = 32;
  const float n = std::max(m.ior, 1.001F);
  float through = 0.0F;  // part of diffuse light from outside
  for (int k = 0; k < steps; ++k) {
    const float cosine = (static_cast<float>(k) + 0.5F) / steps;
    through += 2.0F * cosine * (1.0F - path::fresnel(cosine, n)) / steps;
  }
  const float clear = clear_part(m), mirrored = 1.0F - through / (n * n);
  const Color within = path::Absorption(m).transmittance(thickness);
  const Color back = clear * mirrored + (1.0F - clear) * (1.0F - through + through * m.base_color);
  return clear * through / (n * n) * within / (1.0F - within * back).max(0.05F);
}

}  // namespace

RayScene::RayScene(const RenderScene& scene, const RenderScene& drawn, const DrawnByRays& by_rays)
    : geometry_(scene),
      ambient_(ambient_light(drawn.sky, scene.ground)),
      ground_(scene.ground),
      sky_(drawn.sky),
      has_background_(drawn.background.has_value()),
      ground_alpha_(alpha_for_rays(scene.ground.material)),
      ground_mirror_(scene.ground.material) {
  for (const Mesh& mesh : scene.meshes) {
    const Material& m = mesh.material;
    Surface& surface = surfaces_.emplace_back();
    surface.by_rays = by_rays.meshes[surfaces_.size() - 1];
    const float thickness = mean_chord(mesh.positions, mesh.triangles);
    const Material stand_in = optics_stand_in(m, thickness, surface.by_rays);
    surface.alpha = alpha_for_rays(!surface.by_rays.behind && m.coat > 0.0F ? coat_of(m) : m);
    surface.base_color = stand_in.base_color;
    surface.diffuse = stand_in.base_color;
    if (surface.by_rays.any()) roughest_ = std::max(roughest_, surface.alpha);
    if (surface.by_rays.behind)
      surface.inside = {path::Absorption(m), std::max(m.ior, 1.001F), clear_part(m),
                        lit_within(m, thickness)};
    if (surface.by_rays.mirrored) {
      if (m.coat > 0.0F) {
        surface.mirror.emplace(coat_of(m), m.coat);
      } else {
        surface.mirror.emplace(stand_in);
        surface.diffuse *= 1.0F - m.metallic;
      }
    }
  }
  const std::size_t first_sun = drawn.lights.size() - drawn.suns.size();
  for (const AreaLight& light : scene.lights) met_.emplace_back(light);
  for (std::size_t k = 0; k < drawn.lights.size(); ++k) {
    lights_.emplace_back(drawn.lights[k]);
    if (k >= first_sun && solid_angle(drawn.suns[k - first_sun]) >= small_sun) met_.push_back(lights_.back());
  }
}

RayScene::Mirror::Mirror(const Material& m, float part)
    : metallic(m.metallic), f0(dielectric_f0(m)), share(part), coat{} {
  for (int k = 0; k <= cosines; ++k) {
    const float cosine = std::max(static_cast<float>(k) / cosines, 1e-3F);
    coat[static_cast<std::size_t>(k)] = coat_albedo(cosine, m.roughness);
  }
}

Color RayScene::Mirror::reflectance(float cosine, const Color& base_color) const {
  const float at = std::clamp(cosine, 0.0F, 0x1.fffffep-1F) * cosines;
  const auto k = static_cast<std::size_t>(at);
  const float t = at - static_cast<float>(k);
  const CoatAlbedo &a = coat[k], &b = coat[k + 1];
  const float scale = a.scale + t * (b.scale - a.scale), offset = a.offset + t * (b.offset - a.offset);
  const Color at_normal = (1.0F - metallic) * f0 + metallic * base_color;
  return share * (scale * at_normal + std::min(1.0F, 50.0F * at_normal.maxCoeff()) * offset);
}

Color RayScene::mirrored_by_mesh(const path::MeshHit& hit, const path::TriangleHit& met, float cosine) const {
  const Surface& s = surfaces_[hit.mesh];
  return s.mirror->reflectance(cosine, geometry_.color_at(hit, met).value_or(s.base_color));
}

Color RayScene::mirrored_by_ground(const Vec3& point, float cosine) const {
  return (1.0F - ground_fade(ground_, point)) *
         ground_mirror_.reflectance(cosine, ground_color_at(ground_, point));
}

bool RayScene::light_is_before(const Ray& ray, double far) const {
  return std::any_of(met_.begin(), met_.end(), [&](const path::RectangleLight& light) {
    const double distance = light.visible() ? light.intersect(ray).distance : 0.0;
    return distance > 0.0 && distance < far;
  });
}

Color RayScene::light_met(const Ray& ray, double far) const {
  Color sum = Color::Zero();
  for (const path::RectangleLight& light : met_) {
    const double distance = light.intersect(ray).distance;
    if (distance > 0.0 && distance < far) sum += light.radiance();
  }
  return sum;
}

/// By an opaque mesh.
bool RayScene::is_hidden(const Vec3& from, const Vec3& light) const {
  const Vec3 to = light - from;
  const float distance = to.norm();
  const Ray ray{from, to / distance, 1.0F};
  path::MeshHit hit;
  geometry_.caster().intersect({&ray, 1}, path::Coherence::incoherent, {&hit, 1});
  return hit.mesh != path::MeshHit::none && !surfaces_[hit.mesh].inside &&
         geometry_.meet(ray, hit).t < static_cast<double>(distance);
}

/// Of lights that nothing hides, or none of whose middles, of the sky, and from below, as it falls on what
/// faces down.
Color RayScene::irradiance(const Vec3& point, const Vec3& normal, const Color& from_below,
                           bool with_shadows) const {
  Color sum = Color::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t at = facing(axis, normal);
    sum += normal[axis] * normal[axis] * (at == facing_down ? from_below : ambient_[at]);
  }
  constexpr int side = 3;
  for (const path::RectangleLight& light : lights_) {
    const path::Rectangle& r = light.shape();
    if (with_shadows && is_hidden(point, vec3(r.center))) continue;
    float form = 0.0F;
    for (int k = 0; k < side * side; ++k) {
      const int across = k % side, up = k / side;
      const float x = (static_cast<float>(across) + 0.5F) / side - 0.5F;
      const float y = (static_cast<float>(up) + 0.5F) / side - 0.5F;
      const Vec3 to = vec3(r.center + x * r.width * r.u + y * r.height * r.v) - point;
      const float square = to.squaredNorm();
      const float cosines = std::max(to.dot(normal), 0.0F) * std::max(-to.dot(vec3(r.normal)), 0.0F);
      form += cosines / std::max(square * square, 1e-12F);
    }
    sum += form * r.width * r.height / (side * side) * light.radiance();
  }
  return sum;
}

/// At a point of a body, on all ways to face, of lights that nothing hides.
Color RayScene::mean_irradiance(const Vec3& point) const {
  Color sum = Color::Zero();
  for (const Color& ambient : ambient_) sum += ambient / static_cast<float>(ambient_.size());
  for (const path::RectangleLight& light : lights_) {
    const path::Rectangle& r = light.shape();
    const Vec3 to = vec3(r.center) - point;
    const float distance = std::max(to.norm(), 1e-3F);
    const float facing = std::max(-to.dot(vec3(r.normal)), 0.0F) / distance;
    // A fourth of what falls on a disc that faces it.
    sum += 0.25F * facing * r.width * r.height / (distance * distance) * light.radiance();
  }
  return sum;
}

Color RayScene::of_inner_base(std::size_t mesh, const Vec3& point) const {
  const Surface& s = surfaces_[mesh];
  return std::numbers::inv_pi_v<float> * s.diffuse * s.inside->lit * mean_irradiance(point);
}

Color RayScene::of_ground(const Camera& camera, const DrawnPictures& pictures, const Vec3& point,
                          const Vec3& direction) const {
  const float fade = ground_fade(ground_, point);
  const std::optional<Vec2> at = place_in(camera, point);
  float part = 0.0F;  // that the picture says
  Color seen = Color::Zero();
  if (at && (fade <= 0.0F || !has_background_)) {
    const float facing = std::abs(camera.ray(at->x(), at->y()).direction.y());
    part = std::clamp((facing - least_facing_ground) / least_facing_ground, 0.0F, 1.0F);
    if (part > 0.0F) seen = bilinear(pictures.still, camera.width(), camera.height(), *at);
    if (part >= 1.0F) return seen;
  }
  const bool shadows = part > 0.0F || at;  // where they are looked for
  const Color ground = std::numbers::inv_pi_v<float> * ground_color_at(ground_, point) *
                       irradiance(point, Vec3::UnitY(), ambient_[facing_down], shadows);
  return part * seen + (1.0F - part) * ((1.0F - fade) * ground + fade * sky(direction));
}

/// How much what the picture shows where the camera sees a point of an opaque mesh, at a place in it, is that
/// point: not at silhouettes, whose pixels are stretched over what turns away.
float RayScene::trust(const Camera& camera, const DrawnPictures& pictures, const path::SurfacePoint& surface,
                      const Vec2& place) {
  const Ray ray = camera.ray(place.x(), place.y());
  const float facing = -ray.direction.dot(surface.normal);
  if (facing <= least_facing) return 0.0F;
  const PixelRectangle& r = pictures.surfaces.at;
  const int x = static_cast<int>(place.x()) - r.x,
            y = camera.height() - 1 - static_cast<int>(place.y()) - r.y;
  const float depth = camera.depth(surface.origin);
  const float pixel = camera.pixel_size(depth) / facing;
  for (int k = 0; k < 9; ++k) {
    const SurfaceTexel* texel = pictures.surfaces.find(x + k % 3 - 1, y + k / 3 - 1);
    if (texel == nullptr ||
        std::abs(std::bit_cast<float>(texel->depth) - depth) > 4.0F * pixel + 1e-3F * depth)
      return 0.0F;
  }
  return std::min((facing - least_facing) / least_facing, 1.0F);
}

Color RayScene::of_mesh(const Camera& camera, const DrawnPictures& pictures, const path::MeshHit& hit,
                        const path::TriangleHit& met, const path::SurfacePoint& surface) const {
  Color seen = Color::Zero();
  float part = 0.0F;
  if (const std::optional<Vec2> at = place_in(camera, surface.origin)) {
    part = trust(camera, pictures, surface, *at);
    if (part > 0.0F) seen = bilinear(pictures.solid, camera.width(), camera.height(), *at);
    if (part >= 1.0F) return seen;
  }
  const Surface& s = surfaces_[hit.mesh];
  const std::optional<Color> own = geometry_.color_at(hit, met);
  const Color base = own && !s.by_rays.mirrored ? *own : s.diffuse;
  // What hangs over the ground is lit by what is in its shadow there.
  Color from_below = ambient_[facing_down];
  if (geometry_.ground().met >= 0.0 && surface.origin.y() > ground_.height) {
    const Vec3 under(surface.origin.x(), ground_.height, surface.origin.z());
    from_below = std::numbers::pi_v<float> * of_ground(camera, pictures, under, -Vec3::UnitY());
  }
  return part * seen + (1.0F - part) * std::numbers::inv_pi_v<float> * base *
                           irradiance(surface.origin, surface.normal, from_below, true);
}

}  // namespace lagomorph::render::raster
