#include <algorithm>
#include <cmath>
#include <optional>

#include "render/path/microfacet.h"
#include "render/path/path_batch.h"
#include "render/path/path_dimensions.h"
#include "render/path/path_tracer.h"

/// What the rays of a batch arrive at: triangles, ground, lights and sky, and the light that comes from
/// there.
namespace lagomorph::render::path {

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
  caught_.clear();
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
    if (on_ground && depth == 0 && shading_.ground.shadow_catcher) {
      catch_ground(i, ahead, share);
      continue;
    }
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

/// A path of the camera that ends on a shadow catcher.
void PathTracer::catch_ground(std::size_t i, const Ahead& ahead, float share) {
  const std::uint32_t lane = paths_->lane[i];
  const Ray ray = paths_->rays[i];
  const Vec3 point = vec3(batch_->ground.point[i]);
  const float up = ray.direction.y() < 0.0F ? 1.0F : -1.0F;
  if (first_hits_.empty()) return;
  FirstHit& hit = first_hits_[lane];
  hit.albedo = shading_.textured_ground(point).value_or(shading_.albedos.back());
  hit.normal = Vec3(0.0F, up, 0.0F);
  hit.depth = depth_at(lane, ray, ahead.ground);
  hit.opacity = share;
  hit.catches = true;
  caught_.push_back({point, up, lane});
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

}  // namespace lagomorph::render::path
