#include <algorithm>
#include <limits>
#include <span>

#include "render/path/microfacet.h"
#include "render/path/path_batch.h"
#include "render/path/path_dimensions.h"
#include "render/path/path_tracer.h"

/// Next-event estimation, of what path_tracer.cpp leaves: shadow rays to lights, suns and sky.
namespace lagomorph::render::path {
namespace {

constexpr std::size_t most_lights_at_once = 4;
constexpr std::size_t most_lights_in_rows = 8;  // picked ones: all are sampled everywhere up to so many

/// Of several with probabilities that sum up to 1.
std::size_t picked_of(std::span<const float> probabilities, float u) {
  std::size_t k = 0;
  while (k + 1 < probabilities.size() && u >= probabilities[k]) u -= probabilities[k++];
  return k;
}

}  // namespace

bool PathTracer::all_lights_at(std::uint32_t depth) const {
  return depth == 0 && shading_.lights.size() <= most_lights_at_once;
}

float PathTracer::pick_probability(std::size_t light, std::uint32_t depth) const {
  return all_lights_at(depth) ? 1.0F : shading_.pick[light];
}

void PathTracer::draw_surface_pairs(std::uint32_t dimension, PairRows& pairs) const {
  const SurfaceRows& s = batch_->surfaces;
  draw_pairs(pair_keys(key_, dimension), s.count, s.number.data(), pairs.u.data(), pairs.v.data());
}

/// Shadow rays to the area lights: to each from the first surface when they are few, else to one picked by
/// power.
void PathTracer::gather_lights(std::uint32_t depth) {
  if (shading_.lights.empty()) return;
  Batch& b = *batch_;
  SurfaceRows& s = b.surfaces;
  const Coherence coherence = depth == 0 ? Coherence::coherent : Coherence::incoherent;
  const std::vector<RectangleLight>& lights = shading_.lights;
  if (all_lights_at(depth)) {
    std::fill_n(b.light.begin(), s.count, 0U);
    for (std::size_t k = 0; k < lights.size(); ++k) {
      const std::uint32_t name = dimension(depth, light_dimension + static_cast<std::uint32_t>(k));
      draw_surface_pairs(name, b.pairs);
      sample_light(lights[k].shape(), f3(lights[k].radiance()), 1.0F, 0, b.light, s, b.pairs, b.arriving);
      shadow_surfaces();
      for (const Vertex& v : vertices_) gather_light(v, lights[k], 1.0F, v.samples.pair(name));
      trace_shadows(coherence);
    }
    return;
  }
  const std::uint32_t name = dimension(depth, light_dimension);
  const std::uint32_t choice = dimension(depth, choice_dimension);
  const auto picked = [&](float u) { return picked_of(shading_.pick, u); };
  draw_surface_pairs(name, b.pairs);
  if (lights.size() == 1) {
    std::fill_n(b.light.begin(), s.count, 0U);
  } else {
    draw_surface_pairs(choice, b.choices);
    for (std::size_t i = 0; i < s.count; ++i) b.light[i] = static_cast<std::uint32_t>(picked(b.choices.v[i]));
  }
  if (lights.size() <= most_lights_in_rows) {
    for (std::size_t k = 0; k < lights.size(); ++k) {
      sample_light(lights[k].shape(), f3(lights[k].radiance()), shading_.pick[k],
                   static_cast<std::uint32_t>(k), b.light, s, b.pairs, b.arriving);
    }
  } else {
    for (std::size_t i = 0; i < s.count; ++i) {
      if (s.alive[i] == 0) continue;
      const RectangleLight& light = lights[b.light[i]];
      const RectangleLight::Sample to = light.sample(vec3(s.origin[i]), {b.pairs.u[i], b.pairs.v[i]});
      b.arriving.set(i, f3(to.direction), to.distance * (1.0F - 1e-5F), shading_.pick[b.light[i]] * to.pdf,
                     f3(light.radiance()));
    }
  }
  shadow_surfaces();
  for (const Vertex& v : vertices_) {
    const std::size_t k = picked(v.samples.pair(choice).v);
    gather_light(v, lights[k], shading_.pick[k], v.samples.pair(name));
  }
  trace_shadows(coherence);
}

void PathTracer::gather_light(const Vertex& v, const RectangleLight& light, float pick, Pair s) {
  const RectangleLight::Sample to = light.sample(v.origin, s);
  // The light is no obstacle; 1e-5 short of it so that a mesh around it is none either.
  gather(v, to.direction, to.distance * (1.0F - 1e-5F), pick * to.pdf, light.radiance());
}

/// A shadow ray for light from a direction, of a density.
void PathTracer::gather(const Vertex& v, const Vec3& direction, float distance, float pdf,
                        const Color& radiance) {
  const Vec3 wi(direction.dot(v.t), direction.dot(v.b), direction.dot(v.n));
  if (pdf <= 0.0F || wi.z() <= 0.0F) return;
  const Brdf::Value f = v.brdf->evaluate(v.view, wi);
  const Color arriving = (power_heuristic(pdf, f.pdf) / pdf) * radiance * f.f_cos * v.throughput;
  push_shadow({v.origin, direction}, distance, arriving, v.lane);
}

/// Shadow rays to the suns, to one picked by its irradiance where they are several.
void PathTracer::gather_suns(std::uint32_t depth) {
  if (shading_.suns.empty()) return;
  Batch& b = *batch_;
  const SurfaceRows& s = b.surfaces;
  const std::uint32_t name = dimension(depth, sun_dimension);
  const std::uint32_t choice = dimension(depth, sun_choice_dimension);
  const auto picked = [&](float u) { return picked_of(shading_.sun_pick, u); };
  constexpr float far = std::numeric_limits<float>::infinity();
  draw_surface_pairs(name, b.pairs);
  if (shading_.suns.size() == 1) {
    sample_sun(shading_.suns.front().disc(), s.count, b.pairs, b.arriving);
  } else {
    draw_surface_pairs(choice, b.choices);
    for (std::size_t i = 0; i < s.count; ++i) {
      const std::size_t k = picked(b.choices.u[i]);
      const SunLight& sun = shading_.suns[k];
      b.arriving.set(i, f3(sun.sample({b.pairs.u[i], b.pairs.v[i]})), far, shading_.sun_pick[k] * sun.pdf(),
                     f3(sun.radiance()));
    }
  }
  shadow_surfaces();
  for (const Vertex& v : vertices_) {
    const std::size_t k = shading_.suns.size() > 1 ? picked(v.samples.pair(choice).u) : 0;
    const SunLight& sun = shading_.suns[k];
    gather(v, sun.sample(v.samples.pair(name)), far, shading_.sun_pick[k] * sun.pdf(), sun.radiance());
  }
  trace_shadows(depth == 0 ? Coherence::coherent : Coherence::incoherent);
}

/// Shadow rays to the sky, spread as the cosine, or as the light of its map.
void PathTracer::gather_sky(std::uint32_t depth) {
  if (shading_.sky.strength <= 0.0F) return;
  Batch& b = *batch_;
  const SurfaceRows& s = b.surfaces;
  const std::uint32_t name = dimension(depth, sky_dimension);
  constexpr float far = std::numeric_limits<float>::infinity();
  draw_surface_pairs(name, b.pairs);
  if (!shading_.sky_sampler) {
    sample_sky(shading_.gradient(), s, b.pairs, b.arriving);
  } else {
    for (std::size_t i = 0; i < s.count; ++i) {
      if (s.alive[i] == 0) continue;
      const SkySampler::Sample to = shading_.sky_sampler->sample({b.pairs.u[i], b.pairs.v[i]});
      b.arriving.set(i, f3(to.direction), far, to.pdf, f3(sky_radiance(shading_.sky, to.direction)));
    }
  }
  shadow_surfaces();
  for (const Vertex& v : vertices_) {
    const Pair pair = v.samples.pair(name);
    if (shading_.sky_sampler) {
      const SkySampler::Sample to = shading_.sky_sampler->sample(pair);
      gather(v, to.direction, far, to.pdf, sky_radiance(shading_.sky, to.direction));
    } else {
      const Vec3 wi = sample_cosine(pair);
      const Vec3 direction = wi.x() * v.t + wi.y() * v.b + wi.z() * v.n;
      gather(v, direction, far, wi.z() * inv_pi, sky_radiance(shading_.sky, direction));
    }
  }
  trace_shadows(Coherence::incoherent);
}

/// Queues the shadow rays of surfaces for the light that may arrive there.
void PathTracer::shadow_surfaces() {
  Batch& b = *batch_;
  ShadowRows& to = *shadows_;
  for (const SurfaceRange& r : b.ranges) {
    weigh_light(*r.material, r.range, b.surfaces, geometry_.ground(), b.arriving);
    for (std::size_t i = r.range.first; i < r.range.last; ++i) {
      if (b.arriving.kept[i] == 0) continue;
      to.push(b.surfaces.origin[i], b.arriving.direction[i], b.arriving.distance[i], b.arriving.radiance[i],
              b.surfaces.lane[i]);
    }
  }
}

/// Queues a shadow ray, unless the ground takes all of it; a fading ground takes its share.
void PathTracer::push_shadow(const Ray& ray, float distance, const Color& arriving, std::uint32_t lane) {
  float through = 1.0F;
  const double ground = geometry_.meet_ground(ray);
  if (ground < distance) through = ground_fade(shading_.ground, geometry_.ground_point(ray, ground));
  if (through <= 0.0F || arriving.maxCoeff() <= 0.0F) return;
  shadows_->push(f3(ray.origin), f3(ray.direction), distance, f3(Color(through * arriving)), lane);
}

void PathTracer::find_blocked(Coherence coherence) {
  ShadowRows& s = *shadows_;
  if (moving_) {
    for (std::size_t i = 0; i < s.rays.count; ++i) s.rays.time[i] = times_[s.lane[i]];
  }
  geometry_.caster().occluded(s.rays, coherence, s.blocked);
  if (shading_.see_through) dim_shadows(coherence);
}

void PathTracer::trace_shadows(Coherence coherence) {
  ShadowRows& s = *shadows_;
  find_blocked(coherence);
  for (std::size_t i = 0; i < s.rays.count; ++i) {
    if (s.blocked[i] == 0) add_light(s.lane[i], color(s.light[i]));
  }
  s.rays.count = 0;
}

/// Light that arrives at the shadow catcher, and what of it meshes let through: a pixel's alpha is by the
/// sums of both over its samples, so that it is exact where nothing or all is hidden.
void PathTracer::catch_shadows() {
  if (caught_.empty()) return;
  constexpr std::uint32_t depth = 0;
  constexpr float far = std::numeric_limits<float>::infinity();
  const std::vector<RectangleLight>& lights = shading_.lights;
  const auto light_from = [&](const Caught& c, const RectangleLight& light, float pick, Pair pair) {
    const RectangleLight::Sample to = light.sample(c.point, pair);
    push_caught(c, to.direction, to.distance * (1.0F - 1e-5F), pick * to.pdf, light.radiance());
  };
  if (all_lights_at(depth)) {
    for (std::size_t k = 0; k < lights.size(); ++k) {
      const std::uint32_t name = dimension(depth, light_dimension + static_cast<std::uint32_t>(k));
      for (const Caught& c : caught_) light_from(c, lights[k], 1.0F, samples_of(c.lane).pair(name));
      trace_caught(Coherence::coherent);
    }
  } else {
    for (const Caught& c : caught_) {
      const PathSamples samples = samples_of(c.lane);
      const std::size_t k = picked_of(shading_.pick, samples.pair(dimension(depth, choice_dimension)).v);
      light_from(c, lights[k], shading_.pick[k], samples.pair(dimension(depth, light_dimension)));
    }
    trace_caught(Coherence::incoherent);
  }
  for (const Caught& c : caught_) {
    if (shading_.suns.empty()) break;
    const PathSamples samples = samples_of(c.lane);
    const std::size_t k =
        shading_.suns.size() > 1
            ? picked_of(shading_.sun_pick, samples.pair(dimension(depth, sun_choice_dimension)).u)
            : 0;
    const SunLight& sun = shading_.suns[k];
    push_caught(c, sun.sample(samples.pair(dimension(depth, sun_dimension))), far,
                shading_.sun_pick[k] * sun.pdf(), sun.radiance());
  }
  trace_caught(Coherence::coherent);
  for (const Caught& c : caught_) {
    if (shading_.sky.strength <= 0.0F) break;
    const Pair pair = samples_of(c.lane).pair(dimension(depth, sky_dimension));
    if (shading_.sky_sampler) {
      const SkySampler::Sample to = shading_.sky_sampler->sample(pair);
      push_caught(c, to.direction, far, to.pdf, sky_radiance(shading_.sky, to.direction));
    } else {
      const Vec3 about_z = sample_cosine(pair);
      const Vec3 direction(about_z.x(), c.up * about_z.z(), about_z.y());
      push_caught(c, direction, far, about_z.z() * inv_pi, sky_radiance(shading_.sky, direction));
    }
  }
  trace_caught(Coherence::incoherent);
}

void PathTracer::push_caught(const Caught& c, const Vec3& direction, float distance, float pdf,
                             const Color& radiance) {
  const float light = luminance(f3(radiance)) * c.up * direction.y() / pdf;
  if (!(pdf > 0.0F && light > 0.0F)) return;
  shadows_->push(f3(c.point), f3(direction), distance, {light, light, light}, c.lane);
}

void PathTracer::trace_caught(Coherence coherence) {
  ShadowRows& s = *shadows_;
  for (std::size_t i = 0; i < s.rays.count; ++i) first_hits_[s.lane[i]].light += s.light[i].x;
  find_blocked(coherence);
  for (std::size_t i = 0; i < s.rays.count; ++i)
    if (s.blocked[i] == 0) first_hits_[s.lane[i]].reached += s.light[i].x;
  s.rays.count = 0;
}

}  // namespace lagomorph::render::path
