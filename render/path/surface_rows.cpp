#include "render/path/surface_rows.h"

#include <limits>

#include "render/path/light_formulas.h"

namespace lagomorph::render::path {
namespace {

LAGOMORPH_INLINE F3 into_frame(const SurfaceRows& s, std::size_t i, F3 a) {
  return {dot(a, s.t[i]), dot(a, s.b[i]), dot(a, s.n[i])};
}
LAGOMORPH_INLINE F3 out_of_frame(const SurfaceRows& s, std::size_t i, F3 a) {
  return a.x * s.t[i] + a.y * s.b[i] + a.z * s.n[i];
}

}  // namespace

LAGOMORPH_RENDER_SIMD void meet_triangles(Meetings& m) {
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < m.count; ++i) {
    const TriangleHit hit = meet_triangle(m.origin[i], m.direction[i], m.corners(i));
    m.t[i] = hit.t;
    m.u[i] = hit.u;
    m.v[i] = hit.v;
  }
}

LAGOMORPH_RENDER_SIMD void meet_ground(const GroundDisc& of, const RayRows& rays, GroundRows& out) {
  const GroundDisc ground = of;
  const std::size_t count = rays.count;
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < count; ++i) out.t[i] = meet_disc(ground, rays.origin[i], rays.direction[i]);
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < count; ++i) {
    const F3 point = point_on_disc(ground, rays.origin[i], rays.direction[i], out.t[i]);
    out.point.set(i, point);
    out.opacity[i] = 1.0F - fade_of_disc(ground, point);
  }
}

LAGOMORPH_RENDER_SIMD void arrive_on_mesh(const Meetings& m, Range range, bool smooth, const GroundDisc& of,
                                          SurfaceRows& out) {
  const GroundDisc ground = of;
  LAGOMORPH_ROWS
  for (std::size_t i = range.first; i < range.last; ++i) {
    const F3 d = m.direction[i];
    const Arrival at = arrive_on_triangle(-d, m.u[i], m.v[i], m.corners(i),
                                          {m.normal_a[i], m.normal_b[i], m.normal_c[i]}, smooth, ground);
    out.origin.set(i, at.origin);
    out.n.set(i, at.normal);
    out.unbent.set(i, at.unbent);
    out.arrival.set(i, d);
  }
}

LAGOMORPH_RENDER_SIMD void arrive_on_ground(Range range, SurfaceRows& out) {
  LAGOMORPH_ROWS
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Arrival at = arrive_on_disc(out.origin[i], out.arrival[i]);
    out.origin.set(i, at.origin);
    out.n.set(i, at.normal);
    out.unbent.set(i, at.unbent);
  }
}

LAGOMORPH_RENDER_SIMD void view_surfaces(const BrdfConstants& m, const CoatAlbedoTable& rougher, Range range,
                                         SurfaceRows& s) {
  LAGOMORPH_ROWS
  for (std::size_t i = range.first; i < range.last; ++i) {
    const F3 n = s.n[i];
    const Frame frame = frame_of(n);
    const F3 to_eye = -s.arrival[i];
    const float pdf = s.least_pdf[i];
    const float least_alpha = 0.5F * std::sqrt(std::max(1.0F - pdf, 0.0F));
    const BrdfView v = view_brdf(m, rougher, {dot(to_eye, frame.t), dot(to_eye, frame.b), dot(to_eye, n)},
                                 least_alpha, s.base_color[i])
                           .view;
    s.t.set(i, frame.t);
    s.b.set(i, frame.b);
    s.wo.set(i, v.wo);
    s.base.set(i, v.base);
    s.multiple.set(i, v.multiple);
    s.f0.set(i, v.f0);
    s.f90[i] = v.f90;
    s.coat_probability[i] = v.coat_probability;
    s.alpha[i] = v.alpha;
    s.root[i] = v.root;
  }
}

LAGOMORPH_RENDER_SIMD void draw_pairs(const PairKeys& keys, std::size_t count, const std::uint32_t* numbers,
                                      float* u, float* v) {
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < count; ++i) {
    const Pair s = pair_of(keys, numbers[i]);
    u[i] = s.u;
    v[i] = s.v;
  }
}

LAGOMORPH_RENDER_SIMD void camera_rays(const Camera::ViewPlane& view, const PairRows& points, RayRows& rays) {
  const F3 position = f3(view.position), right = f3(view.right), up = f3(view.up), forward = f3(view.forward);
  const float width = view.width, height = view.height;
  const bool parallel = view.orthographic;
  const std::size_t count = rays.count;
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < count; ++i) {
    const float x = 2.0F * points.u[i] / width - 1.0F;
    const float y = 1.0F - 2.0F * points.v[i] / height;
    const F3 across = x * right + y * up;
    rays.origin.set(i, select(parallel, position + across, position));
    rays.direction.set(i, select(parallel, forward, normalized(across + forward)));
  }
}

LAGOMORPH_RENDER_SIMD void sample_light(const Rectangle& light, F3 radiance, float pick, std::uint32_t k,
                                        const SurfaceRow<std::uint32_t>& which, const SurfaceRows& s,
                                        const PairRows& pairs, ArrivingRows& out) {
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < s.count; ++i) {
    const LightSample to = sample_rectangle(light, s.origin[i], pairs.u[i], pairs.v[i]);
    const bool here = which[i] == k;
    out.direction.set(i, select(here, to.direction, out.direction[i]));
    // The light is no obstacle; 1e-5 short of it so that a mesh around it is none either.
    out.distance[i] = here ? to.distance * (1.0F - 1e-5F) : out.distance[i];
    out.pdf[i] = here ? pick * to.pdf : out.pdf[i];
    out.radiance.set(i, select(here, radiance, out.radiance[i]));
  }
}

LAGOMORPH_RENDER_SIMD void sample_sun(const SunDisc& sun, std::size_t count, const PairRows& pairs,
                                      ArrivingRows& out) {
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < count; ++i) {
    out.direction.set(i, sun_direction(sun, pairs.u[i], pairs.v[i]));
    out.distance[i] = std::numeric_limits<float>::infinity();
    out.pdf[i] = sun.pdf;
    out.radiance.set(i, sun.radiance);
  }
}

LAGOMORPH_RENDER_SIMD void sample_sky(const SkyGradient& sky, const SurfaceRows& s, const PairRows& pairs,
                                      ArrivingRows& out) {
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < s.count; ++i) {
    const F3 wi = cosine_direction(pairs.u[i], pairs.v[i]);
    const F3 direction = out_of_frame(s, i, wi);
    out.direction.set(i, direction);
    out.distance[i] = std::numeric_limits<float>::infinity();
    out.pdf[i] = wi.z * inv_pi;
    out.radiance.set(i, sky_gradient(sky, direction));
  }
}

LAGOMORPH_RENDER_SIMD void weigh_light(const BrdfConstants& m, Range range, const SurfaceRows& s,
                                       const GroundDisc& of, ArrivingRows& light) {
  const GroundDisc ground = of;
  LAGOMORPH_ROWS
  for (std::size_t i = range.first; i < range.last; ++i) {
    const F3 direction = light.direction[i];
    const F3 wi = into_frame(s, i, direction);
    const BrdfView view = s.view(i);
    const BrdfValue f = evaluate_brdf(view, wi, m);
    const float pdf = light.pdf[i];
    const double to_ground = meet_disc(ground, s.origin[i], direction);
    const float faded = fade_of_disc(ground, point_on_disc(ground, s.origin[i], direction, to_ground));
    const float through = to_ground < static_cast<double>(light.distance[i]) ? faded : 1.0F;
    const float weight = through * power_heuristic(pdf, f.pdf) / pdf;
    const F3 arriving = weight * (light.radiance[i] * f.f_cos * s.throughput[i]);
    light.radiance.set(i, arriving);
    const bool lit = all_of(all_of(pdf > 0.0F, wi.z > 0.0F, view.wo.z > 0.0F), max_of(arriving) > 0.0F);
    light.kept[i] = lit ? s.alive[i] : 0U;
  }
}

LAGOMORPH_RENDER_SIMD void scatter_surfaces(const BrdfConstants& m, Range range, const SurfaceRows& s,
                                            const PairRows& pairs, ScatterRows& out) {
  LAGOMORPH_ROWS
  for (std::size_t i = range.first; i < range.last; ++i) {
    const BrdfView view = s.view(i);
    const F3 wi = brdf_direction(view, pairs.u[i], pairs.v[i]);
    const BrdfValue f = evaluate_brdf(view, wi, m);
    const bool goes = all_of(wi.z > 0.0F, view.wo.z > 0.0F, f.pdf > 0.0F);
    out.direction.set(i, out_of_frame(s, i, wi));
    out.throughput.set(i, (1.0F / f.pdf) * (s.throughput[i] * f.f_cos));
    out.pdf[i] = goes ? f.pdf : 0.0F;
    out.sky_pdf[i] = wi.z * inv_pi;
  }
}

LAGOMORPH_RENDER_SIMD void sky_behind(const SkyGradient& sky, const RayRows& rays, Row3<>& radiance) {
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < rays.count; ++i) radiance.set(i, sky_gradient(sky, rays.direction[i]));
}

LAGOMORPH_RENDER_SIMD void meet_light(const Rectangle& light, const RayRows& rays, Row<float>& distance) {
  LAGOMORPH_ROWS
  for (std::size_t i = 0; i < rays.count; ++i)
    distance[i] = meet_rectangle(light, rays.origin[i], rays.direction[i]);
}

}  // namespace lagomorph::render::path
