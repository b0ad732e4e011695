#include "render/path/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/path/microfacet.h"
#include "render/path/tile_means.h"
#include "render/path/tile_statistics.h"

namespace lagomorph::render::path {
namespace {

constexpr std::size_t batch_size = 1024;
constexpr std::size_t most_lights_at_once = 4;
constexpr std::uint32_t roulette_depth = 3;

// Names of the sample pairs; those of a surface are counted from surface_dimensions * (its depth + 1).
constexpr std::uint32_t pixel_dimension = 0;
constexpr std::uint32_t lens_dimension = 1;
constexpr std::uint32_t time_dimension = 2;  // u
constexpr std::uint32_t surface_dimensions = 16;
constexpr std::uint32_t scatter_dimension = 0;
constexpr std::uint32_t sky_dimension = 1;
constexpr std::uint32_t choice_dimension = 2;   // u: roulette, v: which light
constexpr std::uint32_t through_dimension = 3;  // u: ground or what lies behind it
constexpr std::uint32_t light_dimension = 4;    // and the three after it
constexpr std::uint32_t sun_dimension = 8;
constexpr std::uint32_t sun_choice_dimension = 9;  // u
constexpr std::uint32_t lobe_dimension = 10;
constexpr std::uint32_t clear_dimension = 11;  // of the dielectric's choices
constexpr std::uint32_t entry_dimension = 12;  // u: into the cloudy inside or not
constexpr float unseen = 1e18F;  // density of a direction that next-event estimation never takes: it weighs 1

std::uint32_t dimension(std::uint32_t depth, std::uint32_t name) {
  return surface_dimensions * (depth + 1) + name;
}

/// Power heuristic for one sample of each of two ways [Veach 1997, Eq. 9.13].
float power_heuristic(float pdf, float other) {
  const float a = pdf * pdf;
  const float b = other * other;
  return a / (a + b);
}

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
      samples_(static_cast<std::uint32_t>(samples)),
      bounces_(static_cast<std::uint32_t>(settings.bounces)),
      clear_bounces_(static_cast<std::uint32_t>(settings.transmission_bounces)),
      clamp_(settings.clamp) {
  rays_.reserve(batch_size);
  paths_.reserve(batch_size);
  hits_.reserve(batch_size);
  vertices_.reserve(batch_size);
  shadow_rays_.reserve(batch_size);
  shadow_distances_.reserve(batch_size);
  shadow_light_.reserve(batch_size);
  shadow_lanes_.reserve(batch_size);
  blocked_.reserve(batch_size);
  radiance_.reserve(batch_size);
  times_.reserve(batch_size);
}

void PathTracer::trace(const Tile& tile, const FrameSamples& numbers, float* color,
                       TileStatistics* statistics, TileMeans* means) {
  const auto width = static_cast<std::uint32_t>(tile.x1 - tile.x0);
  const std::uint64_t total =
      static_cast<std::uint64_t>(width) * static_cast<std::uint32_t>(tile.y1 - tile.y0) * samples_;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (std::uint64_t first = 0; first < total; first += batch_size) {
    const std::uint64_t count = std::min<std::uint64_t>(batch_size, total - first);
    const auto place = [&](std::uint64_t i) {
      const auto pixel = static_cast<std::uint32_t>(i / samples_);
      return std::array<int, 2>{tile.x0 + static_cast<int>(pixel % width),
                                tile.y0 + static_cast<int>(pixel / width)};
    };
    begin_batch(count, means != nullptr);
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      const auto [x, y] = place(first + lane);
      begin_path(lane, x, y, numbers.path(x, y, static_cast<int>((first + lane) % samples_)));
    }
    finish_batch();
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      sum += radiance_[lane].cast<double>();
      const auto [x, y] = place(first + lane);
      if (statistics != nullptr)
        statistics->add(x, y, static_cast<int>((first + lane) % samples_), radiance_[lane]);
      if (means != nullptr) means->add(x, y, radiance_[lane], first_hits_[lane]);
      if ((first + lane + 1) % samples_ != 0) continue;
      float* out = color + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width()) +
                                static_cast<std::size_t>(x));
      for (int k = 0; k < 3; ++k) out[k] = static_cast<float>(sum[k] / samples_);
      sum.setZero();
    }
  }
}

void PathTracer::trace(std::span<const PixelSample> of, const FrameSamples& numbers,
                       std::span<Color> radiance, TileMeans* means) {
  for (std::size_t first = 0; first < of.size(); first += batch_size) {
    const std::size_t count = std::min(batch_size, of.size() - first);
    begin_batch(count, means != nullptr);
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      const PixelSample& s = of[first + lane];
      begin_path(lane, s.x, s.y, numbers.path(s.x, s.y, s.sample));
    }
    finish_batch();
    for (std::uint32_t lane = 0; means != nullptr && lane < count; ++lane)
      means->add(of[first + lane].x, of[first + lane].y, radiance_[lane], first_hits_[lane]);
    std::copy(radiance_.begin(), radiance_.end(), radiance.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

void PathTracer::begin_batch(std::size_t count, bool first_hits) {
  rays_.clear();
  paths_.clear();
  radiance_.assign(count, Color::Zero());
  times_.clear();
  first_hits_.assign(first_hits ? count : 0, FirstHit{});
}

/// Lanes begin in order.
void PathTracer::begin_path(std::uint32_t lane, int x, int y, const PathSamples& samples) {
  const Pair s = samples.pair(pixel_dimension);
  const float px = static_cast<float>(x) + 0.5F + filter_.offset(s.u);
  const float py = static_cast<float>(y) + 0.5F + filter_.offset(s.v);
  if (moving_) times_.push_back(samples.pair(time_dimension).u);
  rays_.push_back(shutter_cameras_.empty()
                      ? camera_ray(camera_, px, py, samples)
                      : camera_ray(camera_at(shutter_cameras_, times_.back()), px, py, samples));
  paths_.push_back({Color::Ones(), 0.0F, 0.0F, std::numeric_limits<float>::infinity(), lane, samples});
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

void PathTracer::finish_batch() {
  for (std::uint32_t depth = 0; !paths_.empty(); ++depth) trace_batch(depth);
}

void PathTracer::trace_batch(std::uint32_t depth) {
  hits_.resize(rays_.size());
  if (moving_) {
    for (std::size_t i = 0; i < rays_.size(); ++i) rays_[i].time = times_[paths_[i].lane];
  }
  geometry_.caster().intersect(rays_, depth == 0 ? Coherence::coherent : Coherence::incoherent, hits_);
  if (shading_.see_through) pass_through(depth);
  if (depth == 0) indirect_.assign(radiance_.size(), 0);
  arrive(depth);
  leave_cloudy_insides();
  rays_.clear();
  paths_.clear();
  if (vertices_.empty()) return;
  gather_lights(depth);
  gather_suns(depth);
  gather_sky(depth);
  scatter(depth);
}

/// Ends the rays: light that they meet is added, surfaces become vertices.
void PathTracer::arrive(std::uint32_t depth) {
  vertices_.clear();
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const Ray& ray = rays_[i];
    Path& path = paths_[i];
    Ahead ahead = look(ray, hits_[i]);
    add_light(path.lane, depth == 0 ? seen_by_camera(ray, ahead)
                                    : path.throughput * light_met(ray, path, depth - 1, ahead));
    const bool keep = depth == 0 && !first_hits_.empty();
    if (keep) first_hits_[path.lane].on_light = ahead.on_light;
    if (depth > bounces_ + path.clear) continue;
    float share = 1.0F;
    if (ahead.ground < SceneGeometry::never) {
      // A fading ground before a mesh: the path takes one of them. Before the sky, whose light is added
      // above, it goes on with the ground's share.
      if (!ahead.on_mesh) {
        share = ahead.opacity;
      } else if (ahead.opacity < 1.0F &&
                 path.samples.pair(dimension(depth, through_dimension)).u >= ahead.opacity) {
        ahead.ground = SceneGeometry::never;
      }
    }
    indirect_[path.lane] = depth > path.clear ? 1 : 0;
    if (ahead.ground < SceneGeometry::never) {
      absorb(path, path.inside, ahead.ground);
      const SurfacePoint at = geometry_.arrive_at_ground(ray, ahead.ground);
      const std::optional<Color> color = shading_.textured_ground(geometry_.ground_point(ray, ahead.ground));
      if (keep) {
        keep_first_hit(path.lane, at, color.value_or(shading_.albedos.back()),
                       depth_at(path.lane, ray, ahead.ground), share);
      }
      begin_vertex(at, ray, path, shading_.ground_brdf(), share, color ? &*color : nullptr);
    } else if (ahead.on_mesh) {
      const SurfacePoint at = geometry_.arrive(ray, hits_[i], ahead.mesh);
      const std::optional<Color> color = geometry_.color_at(hits_[i], ahead.mesh);
      const Bsdf& bsdf = shading_.brdfs[hits_[i].mesh];
      if (keep) {
        keep_first_hit(path.lane, at, color.value_or(shading_.albedos[hits_[i].mesh]),
                       depth_at(path.lane, ray, ahead.mesh.t), 1.0F);
      }
      // A ray that comes to a back side without having gone in, as from an eye within a body, was in it.
      const bool from_within = path.inside == nullptr && at.inside && bsdf.transmits();
      absorb(path, from_within ? &bsdf.absorption() : path.inside, ahead.mesh.t);
      begin_vertex(at, ray, path, bsdf, 1.0F, color ? &*color : nullptr);
      if (!at.inside && bsdf.is_cloudy()) {
        const Pair choice = path.samples.pair(dimension(depth, entry_dimension));
        enter_cloudy_inside(ray, hits_[i], at.beyond, choice.u,
                            path.samples.pair(dimension(depth, scatter_dimension)), depth);
      }
    }
  }
}

PathTracer::Ahead PathTracer::look(const Ray& ray, const MeshHit& hit) const {
  Ahead ahead{{SceneGeometry::never, 0.0, 0.0}, geometry_.meet_ground(ray), 0.0F, hit.mesh != MeshHit::none};
  if (ahead.on_mesh) ahead.mesh = geometry_.meet(ray, hit);
  if (ahead.ground < ahead.mesh.t) {
    ahead.opacity = 1.0F - ground_fade(shading_.ground, geometry_.ground_point(ray, ahead.ground));
  }
  if (ahead.opacity <= 0.0F) ahead.ground = SceneGeometry::never;
  return ahead;
}

/// What a camera ray sees besides surfaces: a visible light, which hides what is behind it, or the
/// background.
Color PathTracer::seen_by_camera(const Ray& ray, Ahead& ahead) const {
  double nearest = ahead.mesh.t;
  Color light = Color::Zero();
  for (const RectangleLight& l : shading_.lights) {
    if (!l.visible()) continue;
    const double distance = l.intersect(ray).distance;
    if (distance <= 0.0 || distance >= nearest) continue;
    nearest = distance;
    ahead.on_light = true;
    light = l.radiance();
  }
  if (nearest < ahead.mesh.t) {
    ahead.on_mesh = false;
    if (nearest < ahead.ground) {
      ahead.ground = SceneGeometry::never;
      return light;
    }
  } else if (ahead.on_mesh) {
    return Color::Zero();
  } else {
    light = shading_.open_view(ray.direction);
  }
  return (1.0F - ahead.opacity) * light;
}

/// Light that a scattered ray meets, weighed against next-event estimation from where it left, at depth
/// `from`.
Color PathTracer::light_met(const Ray& ray, const Path& path, std::uint32_t from, const Ahead& ahead) const {
  Color light = Color::Zero();
  for (std::size_t k = 0; k < shading_.lights.size(); ++k) {
    const RectangleLight& l = shading_.lights[k];
    const RectangleLight::Hit hit = l.intersect(ray);
    if (hit.distance <= 0.0F || hit.distance >= ahead.mesh.t) continue;
    const float through = hit.distance < ahead.ground ? 1.0F : 1.0F - ahead.opacity;
    const float pdf = pick_probability(k, from) * l.pdf(ray.origin, hit.point);
    light += (through * power_heuristic(path.bsdf_pdf, pdf)) * l.radiance();
  }
  if (!ahead.on_mesh && ahead.opacity < 1.0F) {
    const float sky_pdf = shading_.sky_sampler ? shading_.sky_sampler->pdf(ray.direction) : path.sky_pdf;
    const float weight = power_heuristic(path.bsdf_pdf, sky_pdf);
    light += ((1.0F - ahead.opacity) * weight) * sky_radiance(shading_.sky, ray.direction);
    for (std::size_t k = 0; k < shading_.suns.size(); ++k) {
      const SunLight& sun = shading_.suns[k];
      if (!sun.contains(ray.direction)) continue;
      const float of_sun = power_heuristic(path.bsdf_pdf, shading_.sun_pick[k] * sun.pdf());
      light += ((1.0F - ahead.opacity) * of_sun) * sun.radiance();
    }
  }
  return light;
}

void PathTracer::keep_first_hit(std::uint32_t lane, const SurfacePoint& at, const Color& albedo, float depth,
                                float opacity) {
  FirstHit& hit = first_hits_[lane];
  hit.albedo = albedo;
  hit.normal = at.unbent;
  hit.depth = depth;
  hit.opacity = opacity;
}

void PathTracer::begin_vertex(const SurfacePoint& at, const Ray& ray, const Path& path, const Bsdf& brdf,
                              float share, const Color* base_color) {
  Vertex& v = vertices_.emplace_back();
  const bool turned = at.inside && brdf.transmits();
  v.origin = turned ? at.beyond : at.origin;
  v.below = turned ? at.origin : at.beyond;
  v.n = turned ? Vec3(-at.normal) : at.normal;
  make_frame(v.n, v.t, v.b);
  v.brdf = &brdf;
  const float least_alpha = path.least_pdf < 1.0F ? 0.5F * std::sqrt(1.0F - path.least_pdf) : 0.0F;
  v.view = brdf.view(Vec3(-ray.direction.dot(v.t), -ray.direction.dot(v.b), -ray.direction.dot(v.n)),
                     least_alpha, base_color);
  v.throughput = share * path.throughput;
  v.least_pdf = path.least_pdf;
  v.lane = path.lane;
  v.samples = path.samples;
  v.inside = path.inside;
  v.clear = path.clear;
  v.compressed = path.compressed;
}

bool PathTracer::all_lights_at(std::uint32_t depth) const {
  return depth == 0 && shading_.lights.size() <= most_lights_at_once;
}

float PathTracer::pick_probability(std::size_t light, std::uint32_t depth) const {
  return all_lights_at(depth) ? 1.0F : shading_.pick[light];
}

/// Shadow rays to the area lights: to each from the first surface when they are few, else to one picked by
/// power.
void PathTracer::gather_lights(std::uint32_t depth) {
  if (shading_.lights.empty()) return;
  const Coherence coherence = depth == 0 ? Coherence::coherent : Coherence::incoherent;
  if (all_lights_at(depth)) {
    for (std::size_t k = 0; k < shading_.lights.size(); ++k) {
      const auto name = light_dimension + static_cast<std::uint32_t>(k);
      for (const Vertex& v : vertices_)
        gather_light(v, shading_.lights[k], 1.0F, v.samples.pair(dimension(depth, name)));
      trace_shadows(coherence);
    }
    return;
  }
  for (const Vertex& v : vertices_) {
    float left = v.samples.pair(dimension(depth, choice_dimension)).v;
    std::size_t k = 0;
    while (k + 1 < shading_.lights.size() && left >= shading_.pick[k]) left -= shading_.pick[k++];
    gather_light(v, shading_.lights[k], shading_.pick[k], v.samples.pair(dimension(depth, light_dimension)));
  }
  trace_shadows(coherence);
}

void PathTracer::gather_light(const Vertex& v, const RectangleLight& light, float pick, Pair s) {
  const RectangleLight::Sample to = light.sample(v.origin, s);
  const Vec3 wi(to.direction.dot(v.t), to.direction.dot(v.b), to.direction.dot(v.n));
  const float pdf = pick * to.pdf;
  if (pdf <= 0.0F || wi.z() <= 0.0F) return;
  const Brdf::Value f = v.brdf->evaluate(v.view, wi);
  const Color arriving = (power_heuristic(pdf, f.pdf) / pdf) * light.radiance() * f.f_cos * v.throughput;
  // The light is no obstacle; 1e-5 short of it so that a mesh around it is none either.
  push_shadow({v.origin, to.direction}, to.distance * (1.0F - 1e-5F), arriving, v.lane);
}

/// Shadow rays to the suns, to one picked by its irradiance where they are several.
void PathTracer::gather_suns(std::uint32_t depth) {
  if (shading_.suns.empty()) return;
  for (const Vertex& v : vertices_) {
    std::size_t k = 0;
    if (shading_.suns.size() > 1) {
      float left = v.samples.pair(dimension(depth, sun_choice_dimension)).u;
      while (k + 1 < shading_.suns.size() && left >= shading_.sun_pick[k]) left -= shading_.sun_pick[k++];
    }
    const SunLight& sun = shading_.suns[k];
    const Vec3 direction = sun.sample(v.samples.pair(dimension(depth, sun_dimension)));
    const Vec3 wi(direction.dot(v.t), direction.dot(v.b), direction.dot(v.n));
    if (wi.z() <= 0.0F) continue;
    const float pdf = shading_.sun_pick[k] * sun.pdf();
    const Brdf::Value f = v.brdf->evaluate(v.view, wi);
    const Color arriving = (power_heuristic(pdf, f.pdf) / pdf) * sun.radiance() * f.f_cos * v.throughput;
    push_shadow({v.origin, direction}, std::numeric_limits<float>::infinity(), arriving, v.lane);
  }
  trace_shadows(depth == 0 ? Coherence::coherent : Coherence::incoherent);
}

/// Shadow rays to the sky, spread as the cosine, or as the light of its map.
void PathTracer::gather_sky(std::uint32_t depth) {
  if (shading_.sky.strength <= 0.0F) return;
  for (const Vertex& v : vertices_) {
    const Pair s = v.samples.pair(dimension(depth, sky_dimension));
    Vec3 wi, direction;
    float pdf = 0.0F;
    if (shading_.sky_sampler) {
      const SkySampler::Sample to = shading_.sky_sampler->sample(s);
      direction = to.direction;
      wi = Vec3(direction.dot(v.t), direction.dot(v.b), direction.dot(v.n));
      pdf = wi.z() > 0.0F ? to.pdf : 0.0F;
    } else {
      wi = sample_cosine(s);
      pdf = wi.z() * inv_pi;
      direction = wi.x() * v.t + wi.y() * v.b + wi.z() * v.n;
    }
    if (pdf <= 0.0F) continue;
    const Brdf::Value f = v.brdf->evaluate(v.view, wi);
    const Color arriving =
        (power_heuristic(pdf, f.pdf) / pdf) * sky_radiance(shading_.sky, direction) * f.f_cos * v.throughput;
    push_shadow({v.origin, direction}, std::numeric_limits<float>::infinity(), arriving, v.lane);
  }
  trace_shadows(Coherence::incoherent);
}

/// Queues a shadow ray, unless the ground takes all of it; a fading ground takes its share.
void PathTracer::push_shadow(const Ray& ray, float distance, const Color& arriving, std::uint32_t lane) {
  float through = 1.0F;
  const double ground = geometry_.meet_ground(ray);
  if (ground < distance) through = ground_fade(shading_.ground, geometry_.ground_point(ray, ground));
  if (through <= 0.0F || arriving.maxCoeff() <= 0.0F) return;
  shadow_rays_.push_back(ray);
  shadow_distances_.push_back(distance);
  shadow_light_.push_back(through * arriving);
  shadow_lanes_.push_back(lane);
}

void PathTracer::trace_shadows(Coherence coherence) {
  blocked_.resize(shadow_rays_.size());
  if (moving_) {
    for (std::size_t i = 0; i < shadow_rays_.size(); ++i) shadow_rays_[i].time = times_[shadow_lanes_[i]];
  }
  geometry_.caster().occluded(shadow_rays_, shadow_distances_, coherence, blocked_);
  if (shading_.see_through) dim_shadows(coherence);
  for (std::size_t i = 0; i < shadow_rays_.size(); ++i) {
    if (blocked_[i] == 0) add_light(shadow_lanes_[i], shadow_light_[i]);
  }
  shadow_rays_.clear();
  shadow_distances_.clear();
  shadow_light_.clear();
  shadow_lanes_.clear();
}

/// The next rays, by the BSDF; dim paths end by Russian roulette.
void PathTracer::scatter(std::uint32_t depth) {
  for (const Vertex& v : vertices_) {
    const auto pair = [&](std::uint32_t name) { return v.samples.pair(dimension(depth, name)); };
    const bool layers = v.brdf->has_layers();
    const Bsdf::Sample s =
        v.brdf->sample(v.view, pair(scatter_dimension), layers ? pair(lobe_dimension) : Pair{},
                       layers ? pair(clear_dimension) : Pair{});
    if (s.value.pdf <= 0.0F) continue;
    Color throughput = v.throughput * s.value.f_cos / s.value.pdf;
    const Vec3& wi = s.direction;
    const float compressed =
        layers && !v.view.emerging ? v.compressed / v.brdf->index_squared(v.view.wo, wi) : v.compressed;
    const float bright = throughput.maxCoeff() / compressed;
    if (bright <= 0.0F) continue;
    if (depth >= roulette_depth && bright < 1.0F) {
      if (pair(choice_dimension).u >= bright) continue;
      throughput /= bright;
    }
    const bool below = wi.z() < 0.0F;
    rays_.push_back({below ? v.below : v.origin, wi.x() * v.t + wi.y() * v.b + wi.z() * v.n});
    Path& path = paths_.emplace_back();
    path.throughput = throughput;
    path.bsdf_pdf = below ? unseen : s.value.pdf;
    path.sky_pdf = wi.z() * inv_pi;
    path.least_pdf = std::min(v.least_pdf, s.value.pdf);
    path.lane = v.lane;
    path.samples = v.samples;
    path.inside = v.inside;
    if (v.brdf->transmits()) path.inside = below ? &v.brdf->absorption() : nullptr;
    path.clear = s.clear ? std::min(v.clear + 1, clear_bounces_) : v.clear;
    path.compressed = compressed;
  }
}

}  // namespace lagomorph::render::path
