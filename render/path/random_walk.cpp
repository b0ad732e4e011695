#include "render/path/random_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lagomorph::render::path {
namespace {

constexpr std::uint32_t roulette_step = 8;
// Pairs of samples, far from those of surfaces.
constexpr std::uint32_t first_dimension = 1U << 20U;
constexpr std::uint32_t dimensions_of_a_walk = 4 * RandomWalk::most_steps;

Vec3 uniform_direction(Pair s) {
  const float z = 1.0F - 2.0F * s.u;
  const float radius = std::sqrt(std::max(1.0F - z * z, 0.0F));
  const float phi = 2.0F * std::numbers::pi_v<float> * s.v;
  return {radius * std::cos(phi), radius * std::sin(phi), z};
}

}  // namespace

void RandomWalk::begin(const Ray& from, std::uint32_t mesh, const CloudyInside& inside,
                       const PathSamples& samples, std::uint32_t depth) {
  rays_.push_back(from);
  walks_.push_back(
      {&inside, samples, Color::Ones(), mesh, begun_++, first_dimension + depth * dimensions_of_a_walk, 0});
}

const std::vector<RandomWalk::Exit>& RandomWalk::finish(const SceneGeometry& geometry) {
  exits_.assign(begun_, {});
  begun_ = 0;
  while (!walks_.empty()) {
    hits_.resize(rays_.size());
    geometry.caster().intersect(rays_, Coherence::incoherent, hits_);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < walks_.size(); ++i) {
      if (!step(walks_[i], rays_[i], hits_[i], geometry)) continue;
      walks_[kept] = walks_[i];
      rays_[kept++] = rays_[i];
    }
    walks_.resize(kept);
    rays_.resize(kept);
  }
  return exits_;
}

/// Over the next scattering, or to the surface; false when the walk has ended.
bool RandomWalk::step(Walk& w, Ray& ray, const MeshHit& hit, const SceneGeometry& geometry) {
  if (hit.mesh == MeshHit::none || ++w.steps > most_steps) return false;
  const Color& extinction = w.inside->extinction;
  const Pair way = w.samples.pair(w.number++);
  // Colours by what they would carry on.
  Color pick = w.weight * w.inside->albedo;
  if (!(pick.sum() > 0.0F)) pick = w.weight;
  pick /= pick.sum();
  float u = way.u;
  int colour = 0;
  while (colour < 2 && u >= pick[colour]) u -= pick[colour++];
  const float distance = -std::log(1.0F - way.v) / extinction[colour];

  const TriangleHit at = geometry.meet(ray, hit);
  const auto to_surface = static_cast<float>(std::max(at.t, 0.0));
  if (distance >= to_surface) {
    const Color passed = (-to_surface * extinction).exp();
    w.weight *= passed / (pick * passed).sum();
    const SurfacePoint point = geometry.arrive(ray, hit, at);
    if (hit.mesh != w.mesh) {
      ray.origin = point.beyond;
      return true;
    }
    exits_[w.exit] = point.inside ? Exit{true, point.beyond, -point.normal, w.weight}
                                  : Exit{true, point.origin, point.normal, w.weight};
    return false;
  }
  const Color scattered = (-distance * extinction).exp() * extinction;
  w.weight *= w.inside->albedo * scattered / (pick * scattered).sum();
  if (!(w.weight.maxCoeff() > 0.0F)) return false;
  if (w.steps >= roulette_step) {
    const float stay = std::min(w.weight.maxCoeff(), 1.0F);
    if (w.samples.pair(w.number++).u >= stay) return false;
    w.weight /= stay;
  }
  ray.origin += distance * ray.direction;
  ray.direction = uniform_direction(w.samples.pair(w.number++));
  return true;
}

}  // namespace lagomorph::render::path
