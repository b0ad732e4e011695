#include "render/raster/clear_insides.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <tbb/parallel_for.h>

#include "render/ground_texture.h"
#include "render/path/microfacet.h"
#include "render/raster/stand_ins.h"

namespace lagomorph::render::raster {
namespace {

constexpr int tile_side = 32;      // pixels
constexpr int most_surfaces = 16;  // that a ray meets
constexpr float least_late_share = 0.1F;
constexpr float least_share = 0.02F;   // of the light, for a ray to go on
constexpr float smooth_alpha = 2e-3F;  // up to which surfaces are drawn as if they were smooth
constexpr float rough_alpha = 1e-2F;   // from which on they take four times as many rays
constexpr float least_sun = 3e-3F;     // solid angle of suns that four rays a pixel show without noise [sr]

float alpha_of(const Material& m) { return m.roughness * m.roughness; }

float clear_part(const Material& m) { return (1.0F - m.metallic) * m.transmission; }

/// Of n, sample k of a pixel: a rotated grid of 4, or of 16.
Vec2 sample_place(int k, int n) {
  static constexpr std::array<std::array<float, 2>, 4> rotated = {
      {{0.375F, 0.875F}, {0.875F, 0.625F}, {0.125F, 0.375F}, {0.625F, 0.125F}}};
  const auto& coarse = rotated[static_cast<std::size_t>(k % 4)];
  if (n <= 4) return {coarse[0], coarse[1]};
  const auto& fine = rotated[static_cast<std::size_t>(k / 4 % 4)];
  return {coarse[0] + 0.25F * (fine[0] - 0.5F), coarse[1] + 0.25F * (fine[1] - 0.5F)};
}

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
      const auto at = static_cast<std::size_t>(2 * axis + (d[axis] < 0.0F ? 1 : 0));
      const float weight = std::abs(d[axis]) * 4.0F * std::numbers::pi_v<float> / count;
      sums[at] += weight * light;
      if (of_ground) below[at] += Color::Constant(weight);
    }
  }
  const Color ground_radiance = std::numbers::inv_pi_v<float> * ground.material.base_color * sums[2];
  for (std::size_t k = 0; k < 6; ++k) sums[k] += below[k] * ground_radiance;
  return sums;
}

}  // namespace

ByRays drawn_by_rays(const RenderScene& scene, const Mesh& mesh) {
  const bool clear = clear_part(mesh.material) > 0.0F && mesh.colors.empty() &&
                     std::none_of(scene.meshes.begin(), scene.meshes.end(),
                                  [](const Mesh& m) { return m.material.opacity < 1.0F; });
  if (!clear) return ByRays::nothing;
  const bool misses_none = std::all_of(scene.suns.begin(), scene.suns.end(),
                                       [](const Sun& sun) { return solid_angle(sun) > least_sun; });
  return alpha_of(mesh.material) <= rough_alpha && mesh.material.coat <= 0.0F && misses_none
             ? ByRays::behind_and_mirrored
             : ByRays::behind;
}

float light_through(const Material& m, float thickness) {
  // In and out through surfaces at the mean angle.
  const float once = 1.0F - path::fresnel(2.0F / 3.0F, std::max(m.ior, 1.001F));
  const Color inside = path::Absorption(m).transmittance(thickness);
  return clear_part(m) * once * once * (0.2126F * inside.x() + 0.7152F * inside.y() + 0.0722F * inside.z());
}

ClearInsides::ClearInsides(const RenderScene& scene, std::span<const AreaLight> lights)
    : geometry_(scene),
      ambient_(ambient_light(scene.sky, scene.ground)),
      ground_(scene.ground),
      sky_(scene.sky),
      has_background_(scene.background.has_value()),
      samples_(4) {
  for (const Mesh& mesh : scene.meshes) {
    const Material& m = mesh.material;
    std::optional<Inside>& inside = insides_.emplace_back();
    base_colors_.push_back(m.base_color);
    const ByRays by_rays = drawn_by_rays(scene, mesh);
    if (by_rays == ByRays::nothing) continue;
    const float alpha = alpha_of(m);
    inside = {path::Absorption(m), by_rays == ByRays::behind_and_mirrored, std::max(m.ior, 1.001F),
              alpha <= smooth_alpha ? 0.0F : alpha, clear_part(m)};
    if (alpha > rough_alpha) samples_ = 16;
  }
  for (const AreaLight& light : lights) {
    lights_.emplace_back(light);
    const float distance = (light.position - scene.ground.center).norm();
    const float angle = light.size.prod() / (distance * distance);
    seen_lights_.push_back(angle > least_sun ? 1 : 0);
  }
}

bool ClearInsides::all_are_clear() const {
  return std::all_of(insides_.begin(), insides_.end(), [](const auto& inside) { return inside.has_value(); });
}

/// Of lights that nothing hides, and of the sky.
Color ClearInsides::irradiance(const Vec3& point, const Vec3& normal) const {
  Color sum = Color::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(2 * axis + (normal[axis] < 0.0F ? 1 : 0));
    sum += normal[axis] * normal[axis] * ambient_[at];
  }
  constexpr int side = 3;
  for (const path::RectangleLight& light : lights_) {
    const path::Rectangle& r = light.shape();
    float form = 0.0F;
    for (int k = 0; k < side * side; ++k) {
      const float x = (static_cast<float>(k % side) + 0.5F) / side - 0.5F;
      const float y = (static_cast<float>(k / side) + 0.5F) / side - 0.5F;
      const Vec3 to = vec3(r.center + x * r.width * r.u + y * r.height * r.v) - point;
      const float square = to.squaredNorm();
      const float cosines = std::max(to.dot(normal), 0.0F) * std::max(-to.dot(vec3(r.normal)), 0.0F);
      form += cosines / std::max(square * square, 1e-12F);
    }
    sum += form * r.width * r.height / (side * side) * light.radiance();
  }
  return sum;
}

/// From where a ray meets it, as the picture without meshes shows it; outside of that, lit as if nothing were
/// around.
Color ClearInsides::radiance_of_ground(const Camera& camera, const Pictures& pictures, const Vec3& point,
                                       const Vec3& direction) const {
  const float fade = ground_fade(ground_, point);
  const std::optional<Vec2> at = place_in(camera, point);
  if (at && (fade <= 0.0F || !has_background_))
    return bilinear(pictures.still, camera.width(), camera.height(), *at);
  const Color ground =
      std::numbers::inv_pi_v<float> * ground_color_at(ground_, point) * irradiance(point, Vec3::UnitY());
  return (1.0F - fade) * ground + fade * sky_radiance(sky_, direction);
}

/// As the picture without clear meshes shows it where it is seen there; else as in the open.
Color ClearInsides::radiance_of_mesh(const Camera& camera, const Pictures& pictures, const path::MeshHit& hit,
                                     const path::TriangleHit& met, const path::SurfacePoint& surface) const {
  if (const std::optional<Vec2> at = place_in(camera, surface.origin)) {
    const PixelRectangle& r = pictures.surfaces.at;
    const int x = static_cast<int>(at->x()) - r.x;
    const int y = camera.height() - 1 - static_cast<int>(at->y()) - r.y;
    const SurfaceTexel* texel = pictures.surfaces.find(x, y);
    const float depth = camera.depth(surface.origin);
    if (texel != nullptr && std::abs(std::bit_cast<float>(texel->depth) - depth) <
                                4.0F * camera.pixel_size(depth) + 2e-3F * depth)
      return bilinear(pictures.solid, camera.width(), camera.height(), *at);
  }
  const Color base = geometry_.color_at(hit, met).value_or(base_colors_[hit.mesh]);
  return std::numbers::inv_pi_v<float> * base * irradiance(surface.origin, surface.normal);
}

/// A ray and what the light that comes along it counts for.
struct ClearInsides::Path {
  Ray ray;
  Color share;
  std::uint32_t pixel;   // of the tile
  std::uint32_t sample;  // of the pixel
  std::uint32_t inside;  // the mesh; MeshHit::none: it is outside
};

/// A square of the picture. All rays of a depth are traced together.
class ClearInsides::Tile {
public:
  Tile(const ClearInsides& of, const Camera& camera, const Pictures& pictures, int x0, int y0, int x1, int y1)
      : of_(of),
        camera_(camera),
        pictures_(pictures),
        x0_(x0),
        y0_(y0),
        width_(x1 - x0),
        height_(y1 - y0),
        light_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), Color::Zero()),
        samples_(0, 0, of.samples_) {}

  void trace() {
    begin();
    trace_rays(path::Coherence::coherent);
    enter();
    for (int surface = 1; surface < most_surfaces && !paths_.empty(); ++surface) {
      trace_rays(path::Coherence::incoherent);
      for (std::size_t i = 0; i < paths_.size(); ++i) arrive(i, surface);
      paths_.swap(next_);
      next_.clear();
    }
    // The rest is as bright as where it goes.
    for (const Path& p : paths_) add(p, sky_radiance(of_.sky_, p.ray.direction));
  }

  void add_to(std::span<float> color) const {
    const float weight = 1.0F / static_cast<float>(of_.samples_);
    for (int k = 0; k < width_ * height_; ++k) {
      const int pixel = (y0_ + k / width_) * camera_.width() + x0_ + k % width_;
      float* to = color.data() + 3 * static_cast<std::size_t>(pixel);
      const Color& light = light_[static_cast<std::size_t>(k)];
      for (int c = 0; c < 3; ++c) to[c] += weight * light[c];
    }
  }

private:
  void add(const Path& p, const Color& radiance) { light_[p.pixel] += p.share * radiance; }

  void begin() {
    paths_.reserve(light_.size() * static_cast<std::size_t>(of_.samples_));
    for (std::uint32_t k = 0; k < light_.size(); ++k) {
      const int x = x0_ + static_cast<int>(k) % width_, y = y0_ + static_cast<int>(k) / width_;
      for (int s = 0; s < of_.samples_; ++s) {
        const Vec2 place = sample_place(s, of_.samples_);
        paths_.push_back({camera_.ray(static_cast<float>(x) + place.x(), static_cast<float>(y) + place.y()),
                          Color::Ones(), k, static_cast<std::uint32_t>(s), path::MeshHit::none});
      }
    }
  }

  void trace_rays(path::Coherence coherence) {
    rays_.clear();
    for (const Path& p : paths_) rays_.push_back(p.ray);
    hits_.resize(rays_.size());
    of_.geometry_.caster().intersect(rays_, coherence, hits_);
  }

  /// Distance of a light's shining side before `far`; 0: there is none.
  bool light_is_before(const Ray& ray, double far) const {
    return std::any_of(of_.lights_.begin(), of_.lights_.end(), [&](const path::RectangleLight& light) {
      const double distance = light.visible() ? light.intersect(ray).distance : 0.0;
      return distance > 0.0 && distance < far;
    });
  }

  /// What the camera sees of clear meshes; what these mirror is drawn already.
  void enter() {
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      const path::MeshHit& hit = hits_[i];
      if (hit.mesh == path::MeshHit::none || !of_.insides_[hit.mesh]) continue;
      const Ray& ray = paths_[i].ray;
      const path::TriangleHit met = of_.geometry_.meet(ray, hit);
      if (of_.geometry_.meet_ground(ray) < met.t || light_is_before(ray, met.t)) continue;
      const path::SurfacePoint surface = of_.geometry_.arrive(ray, hit, met);
      const Inside& inside = *of_.insides_[hit.mesh];
      Path p = paths_[i];
      go_on(p, surface, hit.mesh, 0, !inside.mirrors);
    }
    paths_.swap(next_);
    next_.clear();
  }

  void arrive(std::size_t i, int surfaces) {
    const path::MeshHit& hit = hits_[i];
    Path p = paths_[i];
    const bool on_mesh = hit.mesh != path::MeshHit::none;
    const path::TriangleHit met = on_mesh ? of_.geometry_.meet(p.ray, hit) : path::TriangleHit{};
    double far = on_mesh ? met.t : path::SceneGeometry::never;
    const bool is_inside = p.inside != path::MeshHit::none;
    const double ground = is_inside ? path::SceneGeometry::never : of_.geometry_.meet_ground(p.ray);
    const bool on_ground = ground < far;
    if (on_ground) far = ground;
    if (is_inside && on_mesh)
      p.share *= of_.insides_[p.inside]->absorption.transmittance(static_cast<float>(far));
    for (std::size_t k = 0; k < of_.lights_.size(); ++k) {
      if (of_.seen_lights_[k] == 0) continue;
      const double distance = of_.lights_[k].intersect(p.ray).distance;
      if (distance > 0.0 && distance < far) add(p, of_.lights_[k].radiance());
    }
    if (on_ground) {
      const Vec3 point = of_.geometry_.ground_point(p.ray, ground);
      add(p, of_.radiance_of_ground(camera_, pictures_, point, p.ray.direction));
    } else if (!on_mesh) {
      add(p, sky_radiance(of_.sky_, p.ray.direction));
    } else {
      const path::SurfacePoint surface = of_.geometry_.arrive(p.ray, hit, met);
      if (of_.insides_[hit.mesh]) {
        go_on(p, surface, hit.mesh, surfaces, false);
      } else {
        add(p, of_.radiance_of_mesh(camera_, pictures_, hit, met, surface));
      }
    }
  }

  /// The normal of the microfacet that is met.
  Vec3 facet(const Path& p, const path::SurfacePoint& surface, float alpha, int surfaces) const {
    const Vec3& n = surface.normal;
    if (alpha <= 0.0F) return n;
    Vec3 t, b;
    path::make_frame(n, t, b);
    const Vec3 wo(-p.ray.direction.dot(t), -p.ray.direction.dot(b), -p.ray.direction.dot(n));
    const int x = x0_ + static_cast<int>(p.pixel) % width_, y = y0_ + static_cast<int>(p.pixel) / width_;
    const path::PathSamples numbers = samples_.path(x, y, static_cast<int>(p.sample));
    const Vec3 h = path::sample_visible_normal(wo, alpha, numbers.pair(static_cast<std::uint32_t>(surfaces)));
    return (h.x() * t + h.y() * b + h.z() * n).normalized();
  }

  void go_on(const Path& p, const path::SurfacePoint& surface, std::uint32_t mesh, int surfaces,
             bool through_alone) {
    const Inside& inside = *of_.insides_[mesh];
    const float eta = surface.inside ? 1.0F / inside.ior : inside.ior;
    const Vec3 wo = -p.ray.direction;
    const Vec3 h = facet(p, surface, inside.alpha, surfaces);
    const float mirrored = path::fresnel(std::min(wo.dot(h), 1.0F), eta);
    Path on = p, back = p;
    on.share *= 1.0F - mirrored;
    back.share *= mirrored;
    if (surfaces == 0) {
      on.share *= inside.share;
      if (through_alone) back.share = Color::Zero();
    } else {
      // Of a dim one the other takes the share.
      const float least = surfaces < 3 ? least_share : least_late_share;
      if (back.share.maxCoeff() < least || on.share.maxCoeff() < least) {
        const bool back_is_more = mirrored > 0.5F;
        (back_is_more ? back : on).share = p.share;
        (back_is_more ? on : back).share = Color::Zero();
      }
    }
    if (on.share.maxCoeff() > 0.0F) {
      on.ray = {surface.beyond, path::refracted(wo, h, eta).normalized(), 1.0F};
      on.inside = surface.inside ? path::MeshHit::none : mesh;
      next_.push_back(on);
    }
    if (back.share.maxCoeff() > 0.0F) {
      back.ray = {surface.origin, path::reflected(wo, h).normalized(), 1.0F};
      next_.push_back(back);
    }
  }

  const ClearInsides& of_;
  const Camera& camera_;
  const Pictures& pictures_;
  int x0_, y0_, width_, height_;
  std::vector<Color> light_;
  path::FrameSamples samples_;
  std::vector<Path> paths_, next_;
  std::vector<Ray> rays_;
  std::vector<path::MeshHit> hits_;
};

void ClearInsides::add(const Camera& camera, const Pictures& pictures, const PixelRectangle& rectangle,
                       std::span<float> color) {
  geometry_.commit();
  if (rectangle.width <= 0 || rectangle.height <= 0) return;
  const int left = rectangle.x, right = rectangle.x + rectangle.width;
  const int top = camera.height() - rectangle.y - rectangle.height, bottom = camera.height() - rectangle.y;
  const int columns = (rectangle.width + tile_side - 1) / tile_side;
  const int rows = (rectangle.height + tile_side - 1) / tile_side;
  tbb::parallel_for(0, columns * rows, [&](int k) {
    const int x = left + k % columns * tile_side, y = top + k / columns * tile_side;
    Tile tile(*this, camera, pictures, x, y, std::min(x + tile_side, right), std::min(y + tile_side, bottom));
    tile.trace();
    tile.add_to(color);
  });
}

}  // namespace lagomorph::render::raster
