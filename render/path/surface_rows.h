#pragma once

#include <cstddef>
#include <cstdint>

#include "render/path/brdf_formulas.h"
#include "render/path/geometry_formulas.h"
#include "render/path/light_formulas.h"
#include "render/path/rows.h"
#include "render/path/sampler.h"

/// What the path tracer does with all paths of a batch at once: to meet triangles and the ground, to arrive
/// at surfaces whose material is a Brdf alone, to weigh the light there and to scatter. Vector code.
namespace lagomorph::render::path {

/// Where rays meet triangles, in the order of their meshes.
struct Meetings {
  std::size_t count = 0;
  Row<std::uint32_t> ray;  // of the batch
  Row3<> origin, direction;
  Row3<> a, b, c;                       // the triangle's vertices
  Row3<> normal_a, normal_b, normal_c;  // theirs, of smooth meshes
  Row<double> t, u, v;                  // see TriangleHit

  Corners corners(std::size_t i) const { return {a[i], b[i], c[i]}; }
};
/// t, u and v of all.
void meet_triangles(Meetings&);

/// Of each ray: the ground's distance, or infinity, the point there, and how little it fades, in [0, 1].
struct GroundRows {
  Row<double> t;
  Row3<> point;
  Row<float> opacity;
};
void meet_ground(const GroundDisc&, const RayRows&, GroundRows&);

/// Surfaces: a place each for every meeting and then for every ray that ends on the ground.
constexpr std::size_t most_surfaces = 2 * batch_size;
template <class T>
using SurfaceRow = Row<T, most_surfaces>;

struct SurfaceRows {
  std::size_t count = 0;
  SurfaceRow<std::uint32_t> alive;  // 0: no path is there
  SurfaceRow<std::uint32_t> path;   // of the batch
  SurfaceRow<std::uint32_t> lane;
  SurfaceRow<std::uint32_t> number;  // its sample numbers' index
  Row3<most_surfaces> throughput;
  SurfaceRow<float> least_pdf;
  Row3<most_surfaces> base_color;
  Row3<most_surfaces> arrival;  // direction of the ray
  Row3<most_surfaces> origin;   // of rays that go on
  Row3<most_surfaces> n, t, b;  // shading frame
  Row3<most_surfaces> unbent;   // the normal as the surface has it
  // BrdfView
  Row3<most_surfaces> wo, base, multiple, f0;
  SurfaceRow<float> f90, coat_probability, alpha, root;

  BrdfView view(std::size_t i) const {
    return {wo[i], base[i], multiple[i], f0[i], f90[i], coat_probability[i], alpha[i], root[i]};
  }
};

/// Places [first, last) of a batch whose material is the same.
struct Range {
  std::size_t first, last;
};

/// Meeting i becomes surface i: origin, n, unbent and arrival.
void arrive_on_mesh(const Meetings&, Range, bool smooth, const GroundDisc&, SurfaceRows&);
/// Of surfaces whose `origin` is the point of the ground and whose arrival is set.
void arrive_on_ground(Range, SurfaceRows&);
/// The frame and the view, of arrivals with their normal, base colour and least density.
void view_surfaces(const BrdfConstants&, const CoatAlbedoTable&, Range, SurfaceRows&);

/// Number pairs of surfaces.
struct PairRows {
  SurfaceRow<float> u, v;
};
void draw_pairs(const PairKeys&, std::size_t count, const std::uint32_t* numbers, float* u, float* v);

/// Rays through the points (u, v) of the picture [pixels].
void camera_rays(const Camera::ViewPlane&, const PairRows& points, RayRows&);

/// Light that may arrive at surfaces from one direction each.
struct ArrivingRows {
  Row3<most_surfaces> direction;
  SurfaceRow<float> distance;      // of the light [m]
  SurfaceRow<float> pdf;           // of the direction [1/sr]; 0: no light
  Row3<most_surfaces> radiance;    // then what it brings to the picture
  SurfaceRow<std::uint32_t> kept;  // worth a shadow ray

  void set(std::size_t i, F3 to, float far, float density, F3 light) {
    direction.set(i, to);
    distance[i] = far;
    pdf[i] = density;
    radiance.set(i, light);
  }
};
/// Where `which` is k: of the k-th light, that is picked with probability `pick`.
void sample_light(const Rectangle&, F3 radiance, float pick, std::uint32_t k,
                  const SurfaceRow<std::uint32_t>& which, const SurfaceRows&, const PairRows&, ArrivingRows&);
void sample_sun(const SunDisc&, std::size_t count, const PairRows&, ArrivingRows&);
void sample_sky(const SkyGradient&, const SurfaceRows&, const PairRows&, ArrivingRows&);
/// What of that light the surfaces reflect, weighed against the directions that they scatter to, and what a
/// fading ground leaves of it.
void weigh_light(const BrdfConstants&, Range, const SurfaceRows&, const GroundDisc&, ArrivingRows&);

/// The directions that surfaces scatter to.
struct ScatterRows {
  Row3<most_surfaces> direction;
  Row3<most_surfaces> throughput;
  SurfaceRow<float> pdf;      // [1/sr]; 0: the path ends
  SurfaceRow<float> sky_pdf;  // of the same as a cosine
};
void scatter_surfaces(const BrdfConstants&, Range, const SurfaceRows&, const PairRows&, ScatterRows&);

/// Radiance of the sky where rays go, each component a row.
void sky_behind(const SkyGradient&, const RayRows&, Row3<>& radiance);
/// Distance of each ray to a light's shining side [m], 0 where it misses it.
void meet_light(const Rectangle&, const RayRows&, Row<float>& distance);

}  // namespace lagomorph::render::path
