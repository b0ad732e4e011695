#include <algorithm>
#include <numbers>

#include "render/path/path_tracer.h"

/// What path_tracer.cpp leaves of the ways through bodies.
namespace lagomorph::render::path {

void PathTracer::add_light(std::uint32_t lane, const Color& light) {
  const float most = light.maxCoeff();
  const bool cut = clamp_ > 0.0F && indirect_[lane] != 0 && most > clamp_;
  radiance_[lane] += cut ? Color(clamp_ / most * light) : light;
}

/// Over a distance in a clear inside; nullptr: air.
void PathTracer::absorb(Path& path, const Absorption* inside, double distance) {
  if (inside != nullptr && !inside->is_clear())
    path.throughput *= inside->transmittance(static_cast<float>(distance));
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

}  // namespace lagomorph::render::path
