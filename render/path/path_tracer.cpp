#include "render/path/path_tracer.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "render/path/microfacet.h"
#include "render/path/path_batch.h"
#include "render/path/path_dimensions.h"
#include "render/path/tile_means.h"
#include "render/path/tile_statistics.h"

namespace lagomorph::render::path {
namespace {

constexpr std::uint32_t roulette_depth = 3;
constexpr float unseen = 1e18F;  // density of a direction that next-event estimation never takes: it weighs 1

}  // namespace

PathTracer::PathTracer(const SceneGeometry& geometry, const Shading& shading, const Camera& camera,
                       std::span<const Camera> shutter_cameras, const PixelFilter& filter, int samples,
                       const PathSettings& settings)
    : geometry_(geometry),
      shading_(shading),
      camera_(camera),
      shutter_cameras_(shutter_cameras),
      filter_(filter),
      aperture_(camera),
      moving_(geometry.moving()),
      samples_(samples),
      bounces_(static_cast<std::uint32_t>(settings.bounces)),
      clear_bounces_(static_cast<std::uint32_t>(settings.transmission_bounces)),
      clamp_(settings.clamp),
      paths_(std::make_unique<PathRows>()),
      next_(std::make_unique<PathRows>()),
      shadows_(std::make_unique<ShadowRows>()),
      batch_(std::make_unique<Batch>()) {
  for (RayRows* rays : {&paths_->rays, &next_->rays, &shadows_->rays}) rays->time.fill(1.0F);
  for (const RectangleLight& light : shading.lights) any_visible_ = any_visible_ || light.visible();
  batch_->meshes.resize(shading.brdfs.size() - 1);
}

PathTracer::PathTracer(PathTracer&&) noexcept = default;
PathTracer::~PathTracer() = default;

void PathTracer::trace(const Tile& tile, const FrameSamples& numbers, float* color,
                       TileStatistics* statistics, TileMeans* means) {
  PixelSample next{tile.x0, tile.y0, 0};
  const auto take = [&](PixelSample& sample) {
    if (next.y >= tile.y1) return false;
    sample = next;
    if (++next.sample < samples_) return true;
    next.sample = 0;
    if (++next.x < tile.x1) return true;
    next.x = tile.x0;
    ++next.y;
    return true;
  };
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  const auto put = [&](const PixelSample& s, const Color& radiance) {
    sum += radiance.cast<double>();
    if (statistics != nullptr) statistics->add(s.x, s.y, s.sample, radiance);
    if (s.sample + 1 < samples_) return;
    float* out = color + 3 * (static_cast<std::size_t>(s.y) * static_cast<std::size_t>(camera_.width()) +
                              static_cast<std::size_t>(s.x));
    for (int k = 0; k < 3; ++k) out[k] = static_cast<float>(sum[k] / samples_);
    sum.setZero();
  };
  trace_all(take, put, numbers, means);
}

void PathTracer::trace(std::span<const PixelSample> of, const FrameSamples& numbers,
                       std::span<Color> radiance, TileMeans* means) {
  std::size_t taken = 0, traced = 0;
  const auto take = [&](PixelSample& sample) {
    if (taken == of.size()) return false;
    sample = of[taken++];
    return true;
  };
  const auto put = [&](const PixelSample&, const Color& value) { radiance[traced++] = value; };
  trace_all(take, put, numbers, means);
}

/// Traces the samples that `take` gives until it returns false, and gives `put` each with its radiance, in
/// the same order. A batch is of samples whose numbers have one key.
template <class Take, class Put>
void PathTracer::trace_all(const Take& take, const Put& put, const FrameSamples& numbers, TileMeans* means) {
  std::array<PixelSample, batch_size> samples;
  PixelSample sample{};
  bool more = take(sample);
  while (more) {
    key_ = numbers.key(sample.x, sample.y);
    std::size_t count = 0;
    std::uint32_t pixel = numbers.pixel(sample.x, sample.y);
    do {
      samples[count] = sample;
      numbers_[count++] = reverse_bits(numbers.index(pixel, sample.sample));
      more = take(sample);
      if (more && (sample.x != samples[count - 1].x || sample.y != samples[count - 1].y)) {
        if (numbers.key(sample.x, sample.y) != key_) break;
        pixel = numbers.pixel(sample.x, sample.y);
      }
    } while (more && count < batch_size);
    radiance_.assign(count, Color::Zero());
    indirect_.assign(count, 0);
    first_hits_.assign(means != nullptr ? count : 0, FirstHit{});
    begin_paths({samples.data(), count});
    for (std::uint32_t depth = 0; paths_->rays.count > 0; ++depth) trace_batch(depth);
    for (std::size_t lane = 0; lane < count; ++lane) {
      put(samples[lane], radiance_[lane]);
      if (means != nullptr) means->add(samples[lane].x, samples[lane].y, radiance_[lane], first_hits_[lane]);
    }
  }
}

/// Path k is of lane k.
void PathTracer::begin_paths(std::span<const PixelSample> of) {
  PathRows& paths = *paths_;
  PairRows& pairs = batch_->pairs;
  paths.rays.count = of.size();
  draw_pairs(pair_keys(key_, pixel_dimension), of.size(), numbers_.data(), pairs.u.data(), pairs.v.data());
  for (std::size_t i = 0; i < of.size(); ++i) {
    pairs.u[i] = static_cast<float>(of[i].x) + 0.5F + filter_.offset(pairs.u[i]);
    pairs.v[i] = static_cast<float>(of[i].y) + 0.5F + filter_.offset(pairs.v[i]);
    if (moving_) times_[i] = samples_of(i).pair(time_dimension).u;
  }
  const bool alike = camera_.lens_radius() <= 0.0F && shutter_cameras_.empty();
  if (alike) camera_rays(camera_.view_plane(), pairs, paths.rays);
  for (std::size_t i = 0; !alike && i < of.size(); ++i) {
    const Ray ray = shutter_cameras_.empty() ? camera_ray(camera_, pairs.u[i], pairs.v[i], samples_of(i))
                                             : camera_ray(camera_at(shutter_cameras_, times_[i]), pairs.u[i],
                                                          pairs.v[i], samples_of(i));
    paths.rays.origin.set(i, f3(ray.origin));
    paths.rays.direction.set(i, f3(ray.direction));
  }
  const auto fill = [&](auto& row, auto value) { std::fill_n(row.begin(), of.size(), value); };
  for (Row<float>* row : {&paths.throughput.x, &paths.throughput.y, &paths.throughput.z}) fill(*row, 1.0F);
  fill(paths.bsdf_pdf, 0.0F);
  fill(paths.sky_pdf, 0.0F);
  fill(paths.least_pdf, std::numeric_limits<float>::infinity());
  std::iota(paths.lane.begin(), paths.lane.begin() + static_cast<std::ptrdiff_t>(of.size()), 0U);
  fill(paths.inside, static_cast<const Absorption*>(nullptr));
  fill(paths.clear, 0U);
  fill(paths.compressed, 1.0F);
}

Ray PathTracer::camera_ray(const Camera& camera, float px, float py, const PathSamples& samples) const {
  return camera.lens_radius() > 0.0F ? camera.ray(px, py, aperture_.point(samples.pair(lens_dimension)))
                                     : camera.ray(px, py);
}

/// Along the view axis of the camera that the path began at. [m]
float PathTracer::depth_at(std::uint32_t lane, const Ray& ray, double distance) const {
  return shutter_cameras_.empty() ? camera_.depth(ray, distance)
                                  : camera_at(shutter_cameras_, times_[lane]).depth(ray, distance);
}

void PathTracer::trace_batch(std::uint32_t depth) {
  RayRows& rays = paths_->rays;
  if (moving_) {
    for (std::size_t i = 0; i < rays.count; ++i) rays.time[i] = times_[paths_->lane[i]];
  }
  geometry_.caster().intersect(rays, depth == 0 ? Coherence::coherent : Coherence::incoherent, batch_->hits);
  if (shading_.see_through) pass_through(depth);
  meet_meshes();
  meet_ground(geometry_.ground(), rays, batch_->ground);
  depth > 0 ? meet_lights(depth - 1) : see_background();
  arrive(depth);
  catch_shadows();
  leave_cloudy_insides();
  next_->rays.count = 0;
  if (batch_->surfaces.count > 0 || !vertices_.empty()) {
    gather_lights(depth);
    gather_suns(depth);
    gather_sky(depth);
    scatter(depth);
  }
  std::swap(paths_, next_);
}

/// The next rays, by the BSDF; dim paths end by Russian roulette.
void PathTracer::scatter(std::uint32_t depth) {
  Batch& b = *batch_;
  const PathRows& paths = *paths_;
  PathRows& next = *next_;
  const SurfaceRows& s = b.surfaces;
  draw_surface_pairs(dimension(depth, scatter_dimension), b.pairs);
  const PairKeys choice = pair_keys(key_, dimension(depth, choice_dimension));
  // What Russian roulette makes of the throughput; false: the path ends.
  const auto goes_on = [&](F3& throughput, float compressed, std::uint32_t number) {
    const float bright = max_of(throughput) / compressed;
    if (!(bright > 0.0F)) return false;
    if (depth < roulette_depth || bright >= 1.0F) return true;
    if (pair_of(choice, number).u >= bright) return false;
    throughput = (1.0F / bright) * throughput;
    return true;
  };
  for (const SurfaceRange& r : b.ranges) {
    scatter_surfaces(*r.material, r.range, s, b.pairs, b.scattered);
    for (std::size_t i = r.range.first; i < r.range.last; ++i) {
      const float pdf = b.scattered.pdf[i];
      if (s.alive[i] == 0 || pdf <= 0.0F) continue;
      const std::uint32_t path = s.path[i];
      F3 throughput = b.scattered.throughput[i];
      if (!goes_on(throughput, paths.compressed[path], s.number[i])) continue;
      const std::size_t k = next.rays.count++;
      next.rays.origin.set(k, s.origin[i]);
      next.rays.direction.set(k, b.scattered.direction[i]);
      next.throughput.set(k, throughput);
      next.bsdf_pdf[k] = pdf;
      next.sky_pdf[k] = b.scattered.sky_pdf[i];
      next.least_pdf[k] = std::min(s.least_pdf[i], pdf);
      next.lane[k] = s.lane[i];
      next.inside[k] = paths.inside[path];
      next.clear[k] = paths.clear[path];
      next.compressed[k] = paths.compressed[path];
    }
  }
  for (const Vertex& v : vertices_) {
    const auto pair = [&](std::uint32_t name) { return v.samples.pair(dimension(depth, name)); };
    const Bsdf::Sample sample =
        v.brdf->sample(v.view, pair(scatter_dimension), pair(lobe_dimension), pair(clear_dimension));
    if (sample.value.pdf <= 0.0F) continue;
    const Vec3& wi = sample.direction;
    const float compressed =
        v.view.emerging ? v.compressed : v.compressed / v.brdf->index_squared(v.view.wo, wi);
    F3 throughput = f3(Color(v.throughput * sample.value.f_cos / sample.value.pdf));
    if (!goes_on(throughput, compressed, v.samples.number())) continue;
    const bool below = wi.z() < 0.0F;
    const std::size_t k = next.rays.count++;
    next.rays.origin.set(k, f3(below ? v.below : v.origin));
    next.rays.direction.set(k, f3(Vec3(wi.x() * v.t + wi.y() * v.b + wi.z() * v.n)));
    next.throughput.set(k, throughput);
    next.bsdf_pdf[k] = below ? unseen : sample.value.pdf;
    next.sky_pdf[k] = wi.z() * inv_pi;
    next.least_pdf[k] = std::min(v.least_pdf, sample.value.pdf);
    next.lane[k] = v.lane;
    next.inside[k] = v.brdf->transmits() ? (below ? &v.brdf->absorption() : nullptr) : v.inside;
    next.clear[k] = sample.clear ? std::min(v.clear + 1, clear_bounces_) : v.clear;
    next.compressed[k] = compressed;
  }
}

}  // namespace lagomorph::render::path
