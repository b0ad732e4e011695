#include "render/path/path_tracer.h"

#include <algorithm>
#include <cmath>
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

/// Where the rays meet triangles, mesh by mesh.
void PathTracer::meet_meshes() {
  Batch& b = *batch_;
  const RayRows& rays = paths_->rays;
  std::fill(b.meshes.begin(), b.meshes.end(), Range{0, 0});
  for (std::size_t i = 0; i < rays.count; ++i) {
    if (b.hits[i].mesh != MeshHit::none) ++b.meshes[b.hits[i].mesh].last;
  }
  std::size_t placed = 0;
  for (Range& mesh : b.meshes) {
    const std::size_t count = mesh.last;
    mesh = {placed, placed};
    placed += count;
  }
  b.meetings.count = placed;
  for (std::size_t i = 0; i < rays.count; ++i) {
    if (b.hits[i].mesh == MeshHit::none) continue;
    const std::size_t at = b.meshes[b.hits[i].mesh].last++;
    b.meeting[i] = static_cast<std::uint32_t>(at);
    b.meetings.origin.set(at, rays.origin[i]);
    b.meetings.direction.set(at, rays.direction[i]);
    geometry_.put_corners(b.hits[i], rays.time[i], b.meetings, at);
  }
  meet_triangles(b.meetings);
}

/// Light of area lights and sky where scattered rays go, weighed against next-event estimation from where
/// they left, at depth `from`.
void PathTracer::meet_lights(std::uint32_t from) {
  Batch& b = *batch_;
  const PathRows& paths = *paths_;
  const RayRows& rays = paths.rays;
  for (Row<float>* row : {&b.met.x, &b.met.y, &b.met.z}) std::fill_n(row->begin(), rays.count, 0.0F);
  for (std::size_t k = 0; k < shading_.lights.size(); ++k) {
    const RectangleLight& light = shading_.lights[k];
    meet_light(light.shape(), rays, b.to_light);
    for (std::size_t i = 0; i < rays.count; ++i) {
      const float distance = b.to_light[i];
      if (distance <= 0.0F) continue;
      const Ahead ahead = look(i);
      if (distance >= ahead.t) continue;
      const float through = distance < ahead.ground ? 1.0F : 1.0F - ahead.opacity;
      const Ray ray = rays[i];
      const float pdf =
          pick_probability(k, from) * light.pdf(ray.origin, ray.origin + distance * ray.direction);
      const float weight = through * power_heuristic(paths.bsdf_pdf[i], pdf);
      b.met.set(i, b.met[i] + weight * f3(light.radiance()));
    }
  }
  if (!shading_.sky.map) sky_behind(shading_.gradient(), rays, b.behind);
}

/// Ends the rays: light that they meet is added, surfaces are arrived at.
void PathTracer::arrive(std::uint32_t depth) {
  Batch& b = *batch_;
  PathRows& paths = *paths_;
  SurfaceRows& s = b.surfaces;
  vertices_.clear();
  const std::size_t on_meshes = b.meetings.count;
  std::fill_n(s.alive.begin(), on_meshes, 0U);
  s.count = on_meshes;
  bool any = false;
  for (std::size_t i = 0; i < paths.rays.count; ++i) {
    const std::uint32_t lane = paths.lane[i];
    Ahead ahead = look(i);
    if (depth == 0) {
      if (any_visible_) {
        add_light(lane, seen_by_camera(i, ahead));
      } else if (!ahead.on_mesh) {
        add_light(lane, color((1.0F - ahead.opacity) * b.behind[i]));
      }
    } else {
      const Color light = light_met(i, ahead);
      if (light.maxCoeff() > 0.0F) add_light(lane, color(paths.throughput[i]) * light);
    }
    const bool keep = depth == 0 && !first_hits_.empty();
    if (keep) first_hits_[lane].on_light = ahead.on_light;
    if (depth > bounces_ + paths.clear[i]) continue;
    float share = 1.0F;
    if (ahead.ground < SceneGeometry::never) {
      // A fading ground before a mesh: the path takes one of them. Before the sky, whose light is added
      // above, it goes on with the ground's share.
      if (!ahead.on_mesh) {
        share = ahead.opacity;
      } else if (ahead.opacity < 1.0F &&
                 samples_of(lane).pair(dimension(depth, through_dimension)).u >= ahead.opacity) {
        ahead.ground = SceneGeometry::never;
      }
    }
    indirect_[lane] = depth > paths.clear[i] ? 1 : 0;
    const bool on_ground = ahead.ground < SceneGeometry::never;
    if (!on_ground && !ahead.on_mesh) continue;
    const std::size_t mesh = on_ground ? shading_.brdfs.size() - 1 : b.hits[i].mesh;
    const Bsdf& bsdf = shading_.brdfs[mesh];
    if (bsdf.has_layers()) {
      arrive_at_layers(i, ahead, depth, share);
      continue;
    }
    any = true;
    const double distance = on_ground ? ahead.ground : ahead.t;
    absorb(paths, i, paths.inside[i], distance);
    std::optional<Color> own;
    std::size_t at = 0;
    if (on_ground) {
      at = s.count++;
      s.origin.set(at, b.ground.point[i]);
      s.arrival.set(at, paths.rays.direction[i]);
      own = shading_.textured_ground(vec3(b.ground.point[i]));
    } else {
      at = b.meeting[i];
      own = geometry_.color_at(b.hits[i], hit_of(i));
    }
    s.alive[at] = 1;
    s.path[at] = static_cast<std::uint32_t>(i);
    s.lane[at] = lane;
    s.number[at] = numbers_[lane];
    s.throughput.set(at, share * paths.throughput[i]);
    s.least_pdf[at] = paths.least_pdf[i];
    s.base_color.set(at, own ? f3(*own) : bsdf.brdf().constants().base_color);
    if (keep) {
      first_hits_[lane].albedo = own.value_or(shading_.albedos[mesh]);
      first_hits_[lane].depth = depth_at(lane, paths.rays[i], distance);
      first_hits_[lane].opacity = share;
    }
  }
  if (any) {
    see_surfaces(on_meshes);
  } else {
    s.count = 0;
    b.ranges.clear();
  }
  if (depth > 0 || first_hits_.empty()) return;
  for (std::size_t i = 0; i < s.count; ++i) {
    if (s.alive[i] != 0) first_hits_[s.lane[i]].normal = vec3(s.unbent[i]);
  }
}

/// The surfaces of Brdfs alone, of meetings and then of the ground.
void PathTracer::see_surfaces(std::size_t on_meshes) {
  Batch& b = *batch_;
  b.ranges.clear();
  for (std::size_t mesh = 0; mesh < b.meshes.size(); ++mesh) {
    const Bsdf& bsdf = shading_.brdfs[mesh];
    const Range range = b.meshes[mesh];
    if (range.first == range.last || bsdf.has_layers()) continue;
    arrive_on_mesh(b.meetings, range, geometry_.is_smooth(mesh), geometry_.ground(), b.surfaces);
    b.ranges.push_back({range, &bsdf.brdf().constants()});
  }
  if (b.surfaces.count > on_meshes) {
    const Range range{on_meshes, b.surfaces.count};
    arrive_on_ground(range, b.surfaces);
    b.ranges.push_back({range, &shading_.ground_brdf().brdf().constants()});
  }
  const CoatAlbedoTable& rougher = coat_albedo_by_roughness();
  for (const SurfaceRange& r : b.ranges) view_surfaces(*r.material, rougher, r.range, b.surfaces);
}

/// A surface with layers becomes a vertex.
void PathTracer::arrive_at_layers(std::size_t i, const Ahead& ahead, std::uint32_t depth, float share) {
  PathRows& paths = *paths_;
  const Ray ray = paths.rays[i];
  const std::uint32_t lane = paths.lane[i];
  const bool keep = depth == 0 && !first_hits_.empty();
  if (ahead.ground < SceneGeometry::never) {
    absorb(paths, i, paths.inside[i], ahead.ground);
    const SurfacePoint at = geometry_.arrive_at_ground(ray, ahead.ground);
    const std::optional<Color> own = shading_.textured_ground(geometry_.ground_point(ray, ahead.ground));
    if (keep) {
      keep_first_hit(lane, at, own.value_or(shading_.albedos.back()), depth_at(lane, ray, ahead.ground),
                     share);
    }
    begin_vertex(at, ray, i, shading_.ground_brdf(), share, own ? &*own : nullptr);
    return;
  }
  const MeshHit& hit = batch_->hits[i];
  const TriangleHit met = hit_of(i);
  const SurfacePoint at = geometry_.arrive(ray, hit, met);
  const std::optional<Color> own = geometry_.color_at(hit, met);
  const Bsdf& bsdf = shading_.brdfs[hit.mesh];
  if (keep)
    keep_first_hit(lane, at, own.value_or(shading_.albedos[hit.mesh]), depth_at(lane, ray, met.t), 1.0F);
  // A ray that comes to a back side without having gone in, as from an eye within a body, was in it.
  const bool from_within = paths.inside[i] == nullptr && at.inside && bsdf.transmits();
  absorb(paths, i, from_within ? &bsdf.absorption() : paths.inside[i], met.t);
  begin_vertex(at, ray, i, bsdf, 1.0F, own ? &*own : nullptr);
  if (!at.inside && bsdf.is_cloudy()) {
    const PathSamples samples = samples_of(lane);
    enter_cloudy_inside(ray, hit, at.beyond, samples.pair(dimension(depth, entry_dimension)).u,
                        samples.pair(dimension(depth, scatter_dimension)), depth);
  }
}

TriangleHit PathTracer::hit_of(std::size_t path) const {
  const Meetings& m = batch_->meetings;
  const std::size_t at = batch_->meeting[path];
  return {m.t[at], m.u[at], m.v[at]};
}

PathTracer::Ahead PathTracer::look(std::size_t path) const {
  const Batch& b = *batch_;
  const bool on_mesh = b.hits[path].mesh != MeshHit::none;
  Ahead ahead{on_mesh ? b.meetings.t[b.meeting[path]] : SceneGeometry::never, b.ground.t[path], 0.0F,
              on_mesh};
  if (ahead.ground < ahead.t) ahead.opacity = b.ground.opacity[path];
  if (ahead.opacity <= 0.0F) ahead.ground = SceneGeometry::never;
  return ahead;
}

/// What the camera sees where nothing is.
void PathTracer::see_background() {
  Batch& b = *batch_;
  const RayRows& rays = paths_->rays;
  if (shading_.background) {
    const Color& color = *shading_.background;
    std::fill_n(b.behind.x.begin(), rays.count, color.x());
    std::fill_n(b.behind.y.begin(), rays.count, color.y());
    std::fill_n(b.behind.z.begin(), rays.count, color.z());
  } else if (!shading_.sky.map && shading_.suns.empty()) {
    sky_behind(shading_.gradient(), rays, b.behind);
  } else {
    for (std::size_t i = 0; i < rays.count; ++i) {
      if (b.hits[i].mesh == MeshHit::none) b.behind.set(i, f3(shading_.open_view(vec3(rays.direction[i]))));
    }
  }
}

/// What a camera ray sees besides surfaces: a visible light, which hides what is behind it, or the
/// background.
Color PathTracer::seen_by_camera(std::size_t path, Ahead& ahead) const {
  const Ray ray = paths_->rays[path];
  double nearest = ahead.t;
  Color light = Color::Zero();
  for (const RectangleLight& l : shading_.lights) {
    if (!l.visible()) continue;
    const double distance = l.intersect(ray).distance;
    if (distance <= 0.0 || distance >= nearest) continue;
    nearest = distance;
    ahead.on_light = true;
    light = l.radiance();
  }
  if (nearest < ahead.t) {
    ahead.on_mesh = false;
    if (nearest < ahead.ground) {
      ahead.ground = SceneGeometry::never;
      return light;
    }
  } else if (ahead.on_mesh) {
    return Color::Zero();
  } else {
    light = color(batch_->behind[path]);
  }
  return (1.0F - ahead.opacity) * light;
}

/// Light that a scattered ray meets, weighed against next-event estimation from where it left.
Color PathTracer::light_met(std::size_t i, const Ahead& ahead) const {
  const Batch& b = *batch_;
  const PathRows& paths = *paths_;
  Color light = color(b.met[i]);
  if (ahead.on_mesh || ahead.opacity >= 1.0F) return light;
  const Vec3 direction = vec3(paths.rays.direction[i]);
  const float sky_pdf = shading_.sky_sampler ? shading_.sky_sampler->pdf(direction) : paths.sky_pdf[i];
  const float weight = (1.0F - ahead.opacity) * power_heuristic(paths.bsdf_pdf[i], sky_pdf);
  light += weight * (shading_.sky.map ? sky_radiance(shading_.sky, direction) : color(b.behind[i]));
  for (std::size_t k = 0; k < shading_.suns.size(); ++k) {
    const SunLight& sun = shading_.suns[k];
    if (!sun.contains(direction)) continue;
    const float of_sun = power_heuristic(paths.bsdf_pdf[i], shading_.sun_pick[k] * sun.pdf());
    light += ((1.0F - ahead.opacity) * of_sun) * sun.radiance();
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

void PathTracer::begin_vertex(const SurfacePoint& at, const Ray& ray, std::size_t path, const Bsdf& brdf,
                              float share, const Color* base_color) {
  const PathRows& paths = *paths_;
  Vertex& v = vertices_.emplace_back();
  const bool turned = at.inside && brdf.transmits();
  v.origin = turned ? at.beyond : at.origin;
  v.below = turned ? at.origin : at.beyond;
  v.n = turned ? Vec3(-at.normal) : at.normal;
  make_frame(v.n, v.t, v.b);
  v.brdf = &brdf;
  v.least_pdf = paths.least_pdf[path];
  const float least_alpha = v.least_pdf < 1.0F ? 0.5F * std::sqrt(1.0F - v.least_pdf) : 0.0F;
  v.view = brdf.view(Vec3(-ray.direction.dot(v.t), -ray.direction.dot(v.b), -ray.direction.dot(v.n)),
                     least_alpha, base_color);
  v.throughput = share * color(paths.throughput[path]);
  v.lane = paths.lane[path];
  v.samples = samples_of(v.lane);
  v.inside = paths.inside[path];
  v.clear = paths.clear[path];
  v.compressed = paths.compressed[path];
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
