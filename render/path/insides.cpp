#include <algorithm>
#include <numbers>

#include "render/path/path_batch.h"
#include "render/path/path_tracer.h"

/// What path_tracer.cpp leaves of the ways through bodies.
namespace lagomorph::render::path {
namespace {

constexpr std::uint32_t most_crossings = 1024;       // of a ray; the last surface stops it
constexpr std::uint32_t first_crossing = 1U << 24U;  // of the sample pairs, behind those of RandomWalk

}  // namespace

/// Over a distance in a clear inside; nullptr: air.
void PathTracer::absorb(PathRows& paths, std::size_t path, const Absorption* inside, double distance) {
  if (inside == nullptr || inside->is_clear()) return;
  const F3 passed = f3(inside->transmittance(static_cast<float>(distance)));
  paths.throughput.set(path, paths.throughput[path] * passed);
}

/// Turns the last vertex into a walk in its body, or leaves what light does without entering: by `choice`;
/// `way` is that of the cosine inwards.
void PathTracer::enter_cloudy_inside(const Ray& ray, const MeshHit& hit, const Vec3& from, float choice,
                                     Pair way, std::uint32_t depth) {
  Vertex& v = vertices_.back();
  const Bsdf::Entry entry = v.brdf->entry(v.view);
  if (entry.pick <= 0.0F) return;
  if (choice >= entry.pick) {
    v.throughput /= 1.0F - entry.pick;
    return;
  }
  const Vec3 into = sample_cosine(way);
  Ray inward = ray;
  inward.origin = from;
  inward.direction = into.x() * v.t + into.y() * v.b - into.z() * v.n;
  walks_.begin(inward, hit.mesh, v.brdf->cloudy_inside(), v.samples, depth);
  v.throughput *= entry.part / entry.pick;
  entered_.push_back(v);
  vertices_.pop_back();
}

/// Where the walks come out, paths are at a surface that only lets light out.
void PathTracer::leave_cloudy_insides() {
  if (entered_.empty()) return;
  const std::vector<RandomWalk::Exit>& exits = walks_.finish(geometry_);
  for (std::size_t i = 0; i < entered_.size(); ++i) {
    if (!exits[i].found) continue;
    Vertex& v = vertices_.emplace_back(entered_[i]);
    v.origin = exits[i].origin;
    v.n = exits[i].normal;
    make_frame(v.n, v.t, v.b);
    v.view = v.brdf->emerging_view();
    v.throughput *= exits[i].weight;
    v.least_pdf = std::min(v.least_pdf, std::numbers::inv_pi_v<float>);
  }
  entered_.clear();
}

/// Whether the path goes on behind the surface that its ray has met after as many others.
bool PathTracer::passes(std::size_t path, std::uint32_t depth, std::uint32_t crossing) const {
  const MeshHit& hit = batch_->hits[path];
  if (hit.mesh == MeshHit::none || crossing >= most_crossings) return false;
  const float opacity = shading_.opacities[hit.mesh];
  return opacity < 1.0F &&
         samples_of(paths_->lane[path]).pair(first_crossing + depth * most_crossings + crossing).u >= opacity;
}

/// Replaces the hits of paths that do not stop there by those further on along the same rays.
void PathTracer::pass_through(std::uint32_t depth) {
  passing_.clear();
  passing_rays_.clear();
  Row<MeshHit>& hits = batch_->hits;
  for (std::size_t i = 0; i < paths_->rays.count; ++i) {
    if (!passes(i, depth, 0)) continue;
    passing_.push_back(i);
    passing_rays_.push_back(paths_->rays[i]);
  }
  for (std::uint32_t crossing = 1; !passing_.empty(); ++crossing) {
    for (std::size_t k = 0; k < passing_.size(); ++k) {
      Ray& ray = passing_rays_[k];
      const MeshHit& hit = hits[passing_[k]];
      ray.origin = geometry_.behind(ray, hit, geometry_.meet(ray, hit));
    }
    passing_hits_.resize(passing_.size());
    geometry_.caster().intersect(passing_rays_, Coherence::incoherent, passing_hits_);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < passing_.size(); ++k) {
      const std::size_t i = passing_[k];
      hits[i] = passing_hits_[k];
      if (!passes(i, depth, crossing)) continue;
      passing_[kept] = i;
      passing_rays_[kept++] = passing_rays_[k];
    }
    passing_.resize(kept);
    passing_rays_.resize(kept);
  }
}

/// Of the blocked shadow rays, those that only meet what is not opaque keep some of their light.
void PathTracer::dim_shadows(Coherence coherence) {
  ShadowRows& s = *shadows_;
  passing_.clear();
  for (std::size_t i = 0; i < s.rays.count; ++i) {
    if (s.blocked[i] != 0) passing_.push_back(i);
  }
  for (std::uint32_t crossing = 0; !passing_.empty() && crossing < most_crossings; ++crossing) {
    passing_rays_.clear();
    for (const std::size_t i : passing_) passing_rays_.push_back(s.rays[i]);
    passing_hits_.resize(passing_.size());
    geometry_.caster().intersect(passing_rays_, coherence, passing_hits_);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < passing_.size(); ++k) {
      const std::size_t i = passing_[k];
      const MeshHit& hit = passing_hits_[k];
      s.blocked[i] = 0;
      if (hit.mesh == MeshHit::none) continue;
      const Ray ray = s.rays[i];
      const TriangleHit at = geometry_.meet(ray, hit);
      if (at.t >= static_cast<double>(s.rays.far[i])) continue;
      s.blocked[i] = 1;
      const float opacity = shading_.opacities[hit.mesh];
      if (opacity >= 1.0F) continue;
      s.light.set(i, (1.0F - opacity) * s.light[i]);
      s.rays.far[i] -= static_cast<float>(at.t);
      s.rays.origin.set(i, f3(geometry_.behind(ray, hit, at)));
      passing_[kept++] = i;
    }
    passing_.resize(kept);
  }
}

}  // namespace lagomorph::render::path
