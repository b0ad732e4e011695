#include "render/raster/ray_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/path/brdf.h"
#include "render/path/dielectric.h"
#include "render/path/sampler.h"
#include "render/raster/ray_samples.h"

namespace lagomorph::render::raster {
namespace {

constexpr int tile_side = 32;             // pixels
constexpr int most_surfaces = 16;         // that a ray meets
constexpr float least_share = 0.02F;      // of the light, of one of two rays for both to go on
constexpr float least_late_share = 0.1F;  // likewise at later surfaces
constexpr int late = 3;
constexpr float most_of_lamp = 1.0F;  // in one of more rays

int rays_a_pixel(float alpha) { return alpha > rough_alpha ? RaySamples::most : RaySamples::fewest; }

/// A square of the picture. All rays of a depth are traced together.
class RayTile {
public:
  RayTile(const RayScene& scene, const Camera& camera, const DrawnPictures& pictures,
          const PixelRectangle& at, int samples, int multisample)
      : scene_(scene),
        camera_(camera),
        pictures_(pictures),
        at_(at),
        samples_(samples),
        multisample_(multisample),
        light_(pixels(), samples),
        replaced_(pixels(), 0.0F),
        numbers_(0, 0, RaySamples::most) {}

  /// What is seen through clear meshes and mirrored by smooth ones.
  void see_meshes() {
    for_samples([&] {
      trace_rays(path::Coherence::coherent);
      for (std::size_t i = 0; i < paths_.size(); ++i) look_at_mesh(i);
      step_on();
      go_on_to_end(1);
    });
  }

  /// What the ground mirrors of meshes, in place of the sky behind them.
  void see_in_ground() {
    for_samples([&] {
      trace_rays(path::Coherence::coherent);
      for (std::size_t i = 0; i < paths_.size(); ++i) look_at_ground(i);
      step_on();
      trace_rays(path::Coherence::incoherent);
      for (std::size_t i = 0; i < paths_.size(); ++i) {
        if (hits_[i].mesh == path::MeshHit::none) continue;
        add(paths_[i], -scene_.sky(paths_[i].ray.direction).min(most_of_lamp));
        arrive(i, 1, false);
      }
      step_on();
      go_on_to_end(2);
    });
  }

  /// Rows from the top. What is not spread by roughness is taken `evenly` or not, see RaySamples.
  void add_to(std::span<float> color, bool evenly) const {
    for (std::size_t i = 0; i < pixels(); ++i) {
      const int k = static_cast<int>(i);
      const int pixel = (at_.y + k / at_.width) * camera_.width() + at_.x + k % at_.width;
      float* to = color.data() + 3 * static_cast<std::size_t>(pixel);
      const float left = 1.0F - replaced_[i] / RaySamples::fewest;
      const Color light = light_.mean(i, evenly);
      for (int c = 0; c < 3; ++c) to[c] = std::max(left * to[c] + light[c], 0.0F);
    }
  }

private:
  /// A ray and what the light that comes along it counts for.
  struct Path {
    Ray ray;
    Color share;
    std::uint32_t pixel;   // of the tile
    std::uint32_t sample;  // of the pixel
    std::uint32_t inside;  // the mesh; MeshHit::none: it is outside
    bool is_spread;        // by a rough surface
  };

  std::size_t pixels() const {
    return static_cast<std::size_t>(at_.width) * static_cast<std::size_t>(at_.height);
  }

  void add(const Path& p, const Color& radiance) { light_.light(p.pixel, p.sample) += p.share * radiance; }

  /// Of a lamp, or a patch of the sky: what a rough surface spreads a bright one into would be grains.
  void add_light(const Path& p, const Color& radiance) {
    const Color light = p.share * radiance;
    light_.light(p.pixel, p.sample) +=
        p.is_spread ? Color(light * std::min(most_of_lamp / std::max(light.maxCoeff(), 1e-6F), 1.0F)) : light;
  }

  /// Calls see() for the rays of the first samples, then for those of the others where they are wanted.
  template <class See>
  void for_samples(const See& see) {
    begin(0, samples_);
    see();
    if (multisample_ == 1) return;
    light_.want_more();
    begin(samples_, RaySamples::most);
    if (!paths_.empty()) see();
  }

  /// With the samples from `first` to `end` of those pixels that take them.
  void begin(int first, int end) {
    for (std::uint32_t k = 0; k < pixels(); ++k) {
      const int x = at_.x + static_cast<int>(k) % at_.width, y = at_.y + static_cast<int>(k) / at_.width;
      for (int s = first; s < std::min(end, light_.count(k)); ++s) {
        const Vec2 place = multisample_ > 1 ? RaySamples::place(s) : Vec2(0.5F, 0.5F);
        paths_.push_back({camera_.ray(static_cast<float>(x) + place.x(), static_cast<float>(y) + place.y()),
                          Color::Ones(), k, static_cast<std::uint32_t>(s), path::MeshHit::none, false});
      }
    }
  }

  void trace_rays(path::Coherence coherence) {
    rays_.clear();
    for (const Path& p : paths_) rays_.push_back(p.ray);
    hits_.resize(rays_.size());
    scene_.geometry().caster().intersect(rays_, coherence, hits_);
  }

  void step_on() {
    paths_.swap(next_);
    next_.clear();
  }

  void go_on_to_end(int surfaces) {
    for (; surfaces < most_surfaces && !paths_.empty(); ++surfaces) {
      trace_rays(path::Coherence::incoherent);
      for (std::size_t i = 0; i < paths_.size(); ++i) arrive(i, surfaces, true);
      step_on();
    }
    // The rest is as bright as where it goes.
    for (const Path& p : paths_) add_light(p, scene_.sky(p.ray.direction));
    paths_.clear();
  }

  void look_at_mesh(std::size_t i) {
    const path::MeshHit& hit = hits_[i];
    if (hit.mesh == path::MeshHit::none || !scene_.surface(hit.mesh).by_rays.any()) return;
    const Ray& ray = paths_[i].ray;
    const path::TriangleHit met = scene_.geometry().meet(ray, hit);
    if (scene_.geometry().meet_ground(ray) < met.t || scene_.light_is_before(ray, met.t)) return;
    const path::SurfacePoint surface = scene_.geometry().arrive(ray, hit, met);
    light_.meet(paths_[i].pixel, paths_[i].sample);
    if (scene_.surface(hit.mesh).inside) {
      if (surface.inside && paths_[i].sample < RaySamples::fewest) replaced_[paths_[i].pixel] += 1.0F;
      pass(paths_[i], surface, hit, met, 0);
    } else {
      mirror(paths_[i], surface, scene_.surface(hit.mesh).alpha, 0,
             scene_.mirrored_by_mesh(hit, met, -ray.direction.dot(surface.normal)));
    }
  }

  /// Whatever is before the ground is drawn over it.
  void look_at_ground(std::size_t i) {
    Path p = paths_[i];
    p.is_spread = scene_.ground_alpha() > 0.0F;
    const double distance = scene_.geometry().meet_ground(p.ray);
    if (distance >= path::SceneGeometry::never) return;
    const path::SurfacePoint surface = scene_.geometry().arrive_at_ground(p.ray, distance);
    light_.meet(p.pixel, p.sample);
    mirror(p, surface, scene_.ground_alpha(), 0,
           scene_.mirrored_by_ground(scene_.geometry().ground_point(p.ray, distance),
                                     -p.ray.direction.dot(surface.normal)));
  }

  void mirror(Path p, const path::SurfacePoint& surface, float alpha, int surfaces,
              const Color& reflectance) {
    p.share *= reflectance;
    if (p.share.maxCoeff() <= (surfaces == 0 ? 0.0F : least_share)) return;
    const Vec3 h = facet(p, surface, alpha, surfaces);
    const Vec3 direction = path::reflected(-p.ray.direction, h).normalized();
    if (direction.dot(surface.normal) <= 0.0F) return;
    p.ray = {surface.origin, direction, 1.0F};
    p.is_spread = p.is_spread || alpha > rough_alpha;
    next_.push_back(p);
  }

  /// `with_lights`: adds those that are met.
  void arrive(std::size_t i, int surfaces, bool with_lights) {
    const path::MeshHit& hit = hits_[i];
    Path p = paths_[i];
    const path::SceneGeometry& geometry = scene_.geometry();
    const bool on_mesh = hit.mesh != path::MeshHit::none;
    const path::TriangleHit met = on_mesh ? geometry.meet(p.ray, hit) : path::TriangleHit{};
    double far = on_mesh ? met.t : path::SceneGeometry::never;
    const bool is_inside = p.inside != path::MeshHit::none;
    const double ground = is_inside ? path::SceneGeometry::never : geometry.meet_ground(p.ray);
    const bool on_ground = ground < far;
    if (on_ground) far = ground;
    if (is_inside && on_mesh)
      p.share *= scene_.surface(p.inside).inside->absorption.transmittance(static_cast<float>(far));
    if (with_lights) add_light(p, scene_.light_met(p.ray, far));
    if (on_ground) {
      const Vec3 point = geometry.ground_point(p.ray, ground);
      add(p, scene_.of_ground(camera_, pictures_, point, p.ray.direction));
    } else if (!on_mesh) {
      add_light(p, scene_.sky(p.ray.direction));
    } else {
      const path::SurfacePoint surface = geometry.arrive(p.ray, hit, met);
      const RayScene::Surface& of = scene_.surface(hit.mesh);
      if (of.inside) {
        pass(p, surface, hit, met, surfaces);
        return;
      }
      add(p, scene_.of_mesh(camera_, pictures_, hit, met, surface));
      if (of.by_rays.mirrored) {
        mirror(p, surface, of.alpha, surfaces,
               scene_.mirrored_by_mesh(hit, met, -p.ray.direction.dot(surface.normal)));
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
    const int x = at_.x + static_cast<int>(p.pixel) % at_.width;
    const int y = at_.y + static_cast<int>(p.pixel) / at_.width;
    const path::PathSamples numbers = numbers_.path(x, y, static_cast<int>(p.sample));
    const Vec3 h = path::sample_visible_normal(wo, alpha, numbers.pair(static_cast<std::uint32_t>(surfaces)));
    return (h.x() * t + h.y() * b + h.z() * n).normalized();
  }

  /// Through the surface of a clear mesh and back from it.
  void pass(const Path& p, const path::SurfacePoint& surface, const path::MeshHit& hit,
            const path::TriangleHit& met, int surfaces) {
    const RayScene::Surface& of = scene_.surface(hit.mesh);
    const RayScene::Inside& inside = *of.inside;
    const float eta = surface.inside ? 1.0F / inside.ior : inside.ior;
    const Vec3 wo = -p.ray.direction;
    const Vec3 h = facet(p, surface, of.alpha, surfaces);
    const float cosine = std::min(wo.dot(h), 1.0F);
    const float mirrored = path::fresnel(cosine, eta), by_base = path::fresnel(cosine, inside.ior);
    Path on = p, back = p;
    on.is_spread = back.is_spread = p.is_spread || of.alpha > rough_alpha;
    on.share *= (1.0F - mirrored) * inside.share;
    back.share *= inside.share * mirrored + (1.0F - inside.share) * by_base;
    if (surfaces > 0 && inside.share < 1.0F) {
      Path base = p;
      base.share *= 1.0F - by_base;
      add(base, surface.inside ? scene_.of_inner_base(hit.mesh, surface.origin)
                               : scene_.of_mesh(camera_, pictures_, hit, met, surface));
    }
    if (surfaces == 0) {
      if (!of.by_rays.mirrored) back.share = Color::Zero();
    } else {
      // Of a dim one the other takes the share.
      const float least = surfaces < late ? least_share : least_late_share;
      if (back.share.maxCoeff() < least || on.share.maxCoeff() < least) {
        const bool back_is_more = back.share.maxCoeff() > on.share.maxCoeff();
        (back_is_more ? back : on).share = on.share + back.share;
        (back_is_more ? on : back).share = Color::Zero();
      }
    }
    if (on.share.maxCoeff() > 0.0F) {
      on.ray = {surface.beyond, path::refracted(wo, h, eta).normalized(), 1.0F};
      on.inside = surface.inside ? path::MeshHit::none : hit.mesh;
      next_.push_back(on);
    }
    if (back.share.maxCoeff() > 0.0F) {
      back.ray = {surface.origin, path::reflected(wo, h).normalized(), 1.0F};
      next_.push_back(back);
    }
  }

  const RayScene& scene_;
  const Camera& camera_;
  const DrawnPictures& pictures_;
  PixelRectangle at_;  // y from the top
  int samples_;        // of every pixel
  int multisample_;
  RaySamples light_;
  std::vector<float>
      replaced_;  // OpenGL's samples of each pixel that begin inside of a mesh, which it leaves out
  path::FrameSamples numbers_;
  std::vector<Path> paths_, next_;
  std::vector<Ray> rays_;
  std::vector<path::MeshHit> hits_;
};

/// Calls see(tile) for those of a rectangle, and adds what they see.
template <class See>
void for_tiles(const RayScene& scene, const Camera& camera, const DrawnPictures& pictures,
               const PixelRectangle& rectangle, int samples, int multisample, bool evenly,
               std::span<float> color, const See& see) {
  if (rectangle.width <= 0 || rectangle.height <= 0) return;
  const int right = rectangle.x + rectangle.width, bottom = camera.height() - rectangle.y;
  const int top = bottom - rectangle.height;
  const int columns = (rectangle.width + tile_side - 1) / tile_side;
  const int rows = (rectangle.height + tile_side - 1) / tile_side;
  tbb::parallel_for(0, columns * rows, [&](int k) {
    const int x = rectangle.x + k % columns * tile_side, y = top + k / columns * tile_side;
    const PixelRectangle at = {x, y, std::min(tile_side, right - x), std::min(tile_side, bottom - y)};
    RayTile tile(scene, camera, pictures, at, samples, multisample);
    see(tile);
    tile.add_to(color, evenly);
  });
}

}  // namespace

void add_by_rays(const RayScene& scene, const Camera& camera, const DrawnPictures& pictures,
                 const PixelRectangle& rectangle, int multisample, std::span<float> color) {
  for_tiles(scene, camera, pictures, rectangle, rays_a_pixel(scene.roughest()), multisample,
            scene.roughest() > rough_alpha, color, [](RayTile& tile) { tile.see_meshes(); });
}

void add_mirrored_by_ground(const RayScene& scene, const Camera& camera, const DrawnPictures& pictures,
                            const PixelRectangle& rectangle, std::span<float> color) {
  for_tiles(scene, camera, pictures, rectangle,
            scene.ground_alpha() > 0.0F ? RaySamples::most : RaySamples::fewest, 4, true, color,
            [](RayTile& tile) { tile.see_in_ground(); });
}

}  // namespace lagomorph::render::raster
