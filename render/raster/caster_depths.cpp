#include "render/raster/caster_depths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include "render/simd.h"

namespace lagomorph::render::raster {
namespace {

/// x and y in texels, z the depth in steps of a DepthMap.
struct MapPoint {
  float x, y, z;
};

/// Rows [first, last) of a square map, and of one seen from the other side where that is asked for.
struct Band {
  std::uint16_t* map;
  std::uint16_t* from_below;  // or nullptr
  int size, first, last;
};

/// Dots as dense as the surface is opaque [Fuchs et al. 1985; Enderton et al. 2010], which the filters of the
/// shadows even out: a plane of points over the texels, another one for each sheet of each body, so that one
/// behind the other they hide as if independent. The rows are of the generalized golden ratio [Roberts 2018]
/// and its like.
struct Dots {
  float step_x, step_y, shift, opacity;

  Dots(const Caster& mesh, bool front) : opacity(mesh.opacity) {
    constexpr std::array<std::array<float, 2>, 4> steps = {{{0.7548776662F, 0.5698402910F},
                                                            {0.4301597090F, 0.7548776662F},
                                                            {0.3819660113F, 0.2360679775F},
                                                            {0.1458980338F, 0.6180339887F}}};
    const int sheet = 2 * mesh.body + (front ? 0 : 1);
    const std::array<float, 2>& s = steps[static_cast<std::size_t>(sheet % 4)];
    step_x = s[0];
    step_y = s[1];
    const int fours = sheet / 4;
    shift = 0.6180339887F * static_cast<float>(fours);
  }
  bool at(int x, int y) const {
    const float along = static_cast<float>(x) * step_x + static_cast<float>(y) * step_y + shift;
    return along - std::floor(along) < opacity;
  }
};

/// Twice the area on the inner side of an edge, from (x, y) on: value + dx * (x' - x); >= least is inside.
struct Edge {
  float x, y, along_x, along_y, least;

  LAGOMORPH_INLINE float at(float px, float py) const { return along_x * (py - y) - along_y * (px - x); }
};
LAGOMORPH_INLINE Edge edge(float x, float y, float to_x, float to_y) {
  const float along_x = to_x - x, along_y = to_y - y;
  // 1/512 of a texel further out than it is, so that rounding leaves no gap between neighbours.
  return {x, y, along_x, along_y, (-1.0F / 512.0F) * (std::abs(along_x) + std::abs(along_y))};
}

/// Depths over the plane of a triangle.
struct DepthPlane {
  float x, y, z, by_x, by_y, low, high;

  LAGOMORPH_INLINE std::uint16_t at(float px, float py) const {
    const float depth = z + by_x * (px - x) + by_y * (py - y);
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): low >= 0, and lround would be a call a texel
    return static_cast<std::uint16_t>(static_cast<std::int32_t>(std::min(std::max(depth, low), high) + 0.5F));
  }
};
LAGOMORPH_INLINE DepthPlane depth_plane(const MapPoint& a, const MapPoint& b, const MapPoint& c, float area) {
  constexpr auto deepest = static_cast<float>(no_depth - 1);
  const auto within = [=](float depth) { return std::min(std::max(depth, 0.0F), deepest); };
  return {a.x,
          a.y,
          a.z,
          ((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) / area,
          ((c.z - a.z) * (b.x - a.x) - (b.z - a.z) * (c.x - a.x)) / area,
          within(std::min(std::min(a.z, b.z), c.z)),
          within(std::max(std::max(a.z, b.z), c.z))};
}

/// Of texels whose middles may be inside: the first and the last along an axis that ends at `end`.
LAGOMORPH_INLINE int first_texel(float low, int least) {
  return std::max(static_cast<int>(std::ceil(std::max(low, -1.0F) - 0.5F)), least);
}
LAGOMORPH_INLINE int last_texel(float high, int end) {
  return std::min(static_cast<int>(std::floor(std::min(high, static_cast<float>(end) + 1.0F) - 0.5F)),
                  end - 1);
}

/// A triangle of positive area as it is drawn.
struct TriangleSetup {
  Edge of_a, of_b, of_c;
  DepthPlane plane;
  int x0, x1, y0, y1;  // texels
};
LAGOMORPH_INLINE TriangleSetup set_up(const MapPoint& a, const MapPoint& b, const MapPoint& c, float area,
                                      const Band& band) {
  return {edge(b.x, b.y, c.x, c.y),
          edge(c.x, c.y, a.x, a.y),
          edge(a.x, a.y, b.x, b.y),
          depth_plane(a, b, c, area),
          first_texel(std::min(std::min(a.x, b.x), c.x), 0),
          last_texel(std::max(std::max(a.x, b.x), c.x), band.size),
          first_texel(std::min(std::min(a.y, b.y), c.y), band.first),
          last_texel(std::max(std::max(a.y, b.y), c.y), band.last)};
}

constexpr int small = 4;  // texels along a side of the square that all of is tried at once
constexpr int texels_at_once = small * small;

/// Of sixteen texels from the first.
struct alignas(64) TexelOffsets {
  std::array<float, texels_at_once> x, y;
};
constexpr TexelOffsets texel_offsets(int width) {
  TexelOffsets by{};
  for (int t = 0; t < texels_at_once; ++t) {
    const int x = t % width, y = t / width;
    by.x[static_cast<std::size_t>(t)] = static_cast<float>(x);
    by.y[static_cast<std::size_t>(t)] = static_cast<float>(y);
  }
  return by;
}
constexpr TexelOffsets in_a_square = texel_offsets(small), in_a_row = texel_offsets(texels_at_once);

/// Into a map of the band's rows.
template <bool dotted>
LAGOMORPH_INLINE void put_triangle(const Dots& dots, const TriangleSetup& t, const Band& band,
                                   std::uint16_t* map) {
  const int x0 = t.x0, x1 = t.x1, y0 = t.y0, y1 = t.y1;
  if (y0 > y1 || x0 > x1) return;
  const DepthPlane& plane = t.plane;
  const auto inside = [&](float px, float py) {
    return static_cast<int>(t.of_a.at(px, py) >= t.of_a.least) &
           static_cast<int>(t.of_b.at(px, py) >= t.of_b.least) &
           static_cast<int>(t.of_c.at(px, py) >= t.of_c.least);
  };
  const auto row_of = [&](int y) {
    return map + static_cast<std::size_t>(y) * static_cast<std::size_t>(band.size);
  };
  if constexpr (dotted) {
    for (int y = y0; y <= y1; ++y) {
      std::uint16_t* row = row_of(y);
      for (int x = x0; x <= x1; ++x) {
        const float px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
        if (inside(px, py) != 0 && dots.at(x, y)) row[x] = std::min(row[x], plane.at(px, py));
      }
    }
    return;
  }
  // Sixteen texels at once, each `by` the first: their depths, no_depth outside.
  constexpr std::size_t lanes = texels_at_once;
  const auto find = [&](const TexelOffsets& by, int x, int y, std::array<std::int32_t, lanes>& depth) {
    const float left = static_cast<float>(x) + 0.5F, lower = static_cast<float>(y) + 0.5F;
    for (std::size_t t = 0; t < lanes; ++t) {
      const float px = left + by.x[t], py = lower + by.y[t];
      const std::int32_t there = plane.at(px, py);
      depth[t] = inside(px, py) != 0 ? there : no_depth;
    }
  };
  const auto put = [](const std::int32_t* from, std::uint16_t* row, std::size_t count) {
    for (std::size_t t = 0; t < count; ++t)
      row[t] = static_cast<std::uint16_t>(std::min(static_cast<std::int32_t>(row[t]), from[t]));
  };
  alignas(64) std::array<std::int32_t, lanes> depth;
  if (x1 - x0 < small && y1 - y0 < small && x0 + small <= band.size) {
    // Most triangles are hardly larger than a texel.
    find(in_a_square, x0, y0, depth);
    const std::int32_t* from = depth.data();
    for (int y = y0; y <= y1; ++y, from += small) put(from, row_of(y) + x0, small);
    return;
  }
  constexpr int width = lanes;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0 / width * width; x <= x1; x += width) {
      find(in_a_row, x, y, depth);
      put(depth.data(), row_of(y) + x, lanes);
    }
  }
}

/// The depth from the other side.
LAGOMORPH_INLINE float turned(float z) { return static_cast<float>(no_depth) - z; }
LAGOMORPH_INLINE MapPoint turned(const MapPoint& p) { return {p.x, p.y, turned(p.z)}; }

/// Twice the area, positive where the front is seen.
LAGOMORPH_INLINE float area_of(const MapPoint& a, const MapPoint& b, const MapPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Of meshes that both sides of are seen, or through.
template <bool dotted>
LAGOMORPH_INLINE void draw_sheets(const Caster& mesh, std::span<const MapPoint> points, const Band& band) {
  const Dots of_front(mesh, true), of_back(mesh, false);
  for (const Triangle& t : mesh.triangles) {
    MapPoint a = points[t[0]], b = points[t[1]];
    const MapPoint c = points[t[2]];
    float area = area_of(a, b, c);
    if (!(area != 0.0F)) continue;
    const bool front = area > 0.0F;
    if (!front) {
      std::swap(a, b);
      area = -area;
    }
    const Dots& dots = front ? of_front : of_back;
    put_triangle<dotted>(dots, set_up(a, b, c, area, band), band, band.map);
    if (band.from_below == nullptr) continue;
    put_triangle<dotted>(dots, set_up(turned(a), turned(b), turned(c), area, band), band, band.from_below);
  }
}

constexpr std::size_t triangles_at_once = 16;
using TriangleLanes = std::array<float, triangles_at_once>;
using TexelLanes = std::array<std::int32_t, triangles_at_once>;

/// Points of triangles, one a lane.
struct alignas(64) PointLanes {
  TriangleLanes x, y, z;

  LAGOMORPH_INLINE MapPoint at(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  LAGOMORPH_INLINE void put(std::size_t lane, const MapPoint& p) {
    x[lane] = p.x, y[lane] = p.y, z[lane] = p.z;
  }
};

/// Triangles of a closed mesh, set up at once.
struct alignas(64) SetupLanes {
  struct Edges {
    TriangleLanes x, y, along_x, along_y, least;
    LAGOMORPH_INLINE void put(std::size_t lane, const Edge& e) {
      x[lane] = e.x, y[lane] = e.y;
      along_x[lane] = e.along_x, along_y[lane] = e.along_y, least[lane] = e.least;
    }
    LAGOMORPH_INLINE Edge at(std::size_t lane) const {
      return {x[lane], y[lane], along_x[lane], along_y[lane], least[lane]};
    }
  };
  Edges of_a, of_b, of_c;
  TriangleLanes z, by_x, by_y, low, high;
  TexelLanes x0, x1, y0, y1, front;  // front: 1, the back: 0, neither: -1

  LAGOMORPH_INLINE TriangleSetup at(std::size_t l) const {
    const Edge c = of_c.at(l);
    return {of_a.at(l), of_b.at(l), c,     {c.x, c.y, z[l], by_x[l], by_y[l], low[l], high[l]},
            x0[l],      x1[l],      y0[l], y1[l]};
  }
};

LAGOMORPH_INLINE void set_up(const PointLanes& first, const PointLanes& second, const PointLanes& third,
                             const Band& band, SetupLanes& to) {
  for (std::size_t l = 0; l < triangles_at_once; ++l) {
    const MapPoint p = first.at(l), q = second.at(l), r = third.at(l);
    const float area = area_of(p, q, r);
    const bool front = area > 0.0F;
    const MapPoint a = {front ? p.x : q.x, front ? p.y : q.y, front ? p.z : turned(q.z)};
    const MapPoint b = {front ? q.x : p.x, front ? q.y : p.y, front ? q.z : turned(p.z)};
    const MapPoint c = {r.x, r.y, front ? r.z : turned(r.z)};
    const TriangleSetup t = set_up(a, b, c, front ? area : -area, band);
    to.of_a.put(l, t.of_a);
    to.of_b.put(l, t.of_b);
    to.of_c.put(l, t.of_c);
    to.z[l] = t.plane.z, to.by_x[l] = t.plane.by_x, to.by_y[l] = t.plane.by_y;
    to.low[l] = t.plane.low, to.high[l] = t.plane.high;
    to.x0[l] = t.x0, to.x1[l] = t.x1, to.y0[l] = t.y0, to.y1[l] = t.y1;
    to.front[l] = front ? 1 : (area < 0.0F ? 0 : -1);
  }
}

/// Of closed meshes, the sides that are seen.
LAGOMORPH_INLINE void draw_closed(const Caster& mesh, std::span<const MapPoint> points, const Band& band) {
  const Dots none(mesh, true);
  PointLanes a{}, b{}, c{};
  SetupLanes set;
  for (std::size_t first = 0; first < mesh.triangles.size(); first += triangles_at_once) {
    const std::size_t count = std::min(triangles_at_once, mesh.triangles.size() - first);
    for (std::size_t l = 0; l < count; ++l) {
      const Triangle& t = mesh.triangles[first + l];
      a.put(l, points[t[0]]), b.put(l, points[t[1]]), c.put(l, points[t[2]]);
    }
    set_up(a, b, c, band, set);
    for (std::size_t l = 0; l < count; ++l) {
      std::uint16_t* const map = set.front[l] > 0 ? band.map : band.from_below;
      if (set.front[l] >= 0 && map != nullptr) put_triangle<false>(none, set.at(l), band, map);
    }
  }
}

LAGOMORPH_RENDER_SIMD void draw_mesh(const Caster& mesh, std::span<const MapPoint> points, const Band& band) {
  if (mesh.opacity < 1.0F) {
    draw_sheets<true>(mesh, points, band);
  } else if (!mesh.closed) {
    draw_sheets<false>(mesh, points, band);
  } else {
    draw_closed(mesh, points, band);
  }
}

/// A mesh in front of a light: its triangles that are in front as a whole, and parts of the others.
struct SeenCaster {
  Caster mesh;
  std::vector<Triangle> triangles;  // of points, in place of the mesh's where some are cut; else empty
  std::vector<MapPoint> points;
};

SeenCaster seen_from_light(const Caster& mesh, const Mat4& clip_from_world, int size) {
  SeenCaster seen{mesh, {}, {}};
  const float half = 0.5F * static_cast<float>(size);
  const auto project = [half](const Vec4& p) {
    const float to = 1.0F / p.w();
    return MapPoint{(p.x() * to + 1.0F) * half, (p.y() * to + 1.0F) * half,
                    (p.z() * to + 1.0F) * (0.5F * static_cast<float>(no_depth))};
  };
  const auto inside = [](const Vec4& p) { return p.z() + p.w() > 0.0F && p.w() > 0.0F; };
  std::vector<Vec4> clip;
  clip.reserve(mesh.positions.size());
  seen.points.reserve(mesh.positions.size());
  bool all_inside = true;
  for (const Vec3& p : mesh.positions) {
    clip.push_back(clip_from_world.leftCols<3>() * p + clip_from_world.col(3));
    const bool before = inside(clip.back());
    all_inside = all_inside && before;
    seen.points.push_back(before ? project(clip.back()) : MapPoint{0.0F, 0.0F, 0.0F});
  }
  if (all_inside) return seen;
  seen.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const std::array<Vec4, 3> corners = {clip[t[0]], clip[t[1]], clip[t[2]]};
    if (std::all_of(corners.begin(), corners.end(), inside)) {
      seen.triangles.push_back(t);
      continue;
    }
    // Cut along z = -w [Sutherland and Hodgman 1974].
    const auto first = static_cast<std::uint32_t>(seen.points.size());
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec4& from = corners[k];
      const Vec4& to = corners[(k + 1) % 3];
      if (inside(from)) seen.points.push_back(project(from));
      if (inside(from) == inside(to)) continue;
      const float a = from.z() + from.w(), b = to.z() + to.w();
      seen.points.push_back(project(from + a / (a - b) * (to - from)));
    }
    for (auto k = first + 2; k < seen.points.size(); ++k) seen.triangles.push_back({first, k - 1, k});
  }
  if (seen.triangles.empty()) seen.points.clear();
  return seen;
}

}  // namespace

void draw_sky_depths(const FrameBlock& frame, std::span<const Caster> meshes, int size,
                     std::vector<DepthMap>& maps, std::vector<DepthMap>* from_below) {
  maps.resize(frame.sky.size());
  if (from_below != nullptr) from_below->resize(maps.size());
  tbb::parallel_for(std::size_t{0}, maps.size(), [&](std::size_t i) {
    const SkyDirectionBlock& sky = frame.sky[i];
    const std::size_t texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    maps[i].assign(texels, no_depth);
    if (from_below != nullptr) (*from_below)[i].assign(texels, no_depth);
    const Band band = {maps[i].data(), from_below != nullptr ? (*from_below)[i].data() : nullptr, size, 0,
                       size};
    const float half = 0.5F * static_cast<float>(size);
    const Vec3 x_axis = half * frame.sky_map[3] * sky.right.head<3>();
    const Vec3 y_axis = half * frame.sky_map[3] * sky.up.head<3>();
    const Vec3 z_axis = -0.5F * static_cast<float>(no_depth) * frame.sky_map[3] * sky.direction.head<3>();
    const Vec3 middle = frame.sky_map.head<3>();
    std::vector<MapPoint> points;
    for (const Caster& mesh : meshes) {
      points.clear();
      points.reserve(mesh.positions.size());
      for (const Vec3& p : mesh.positions) {
        const Vec3 d = p - middle;
        points.push_back({d.dot(x_axis) + half, d.dot(y_axis) + half,
                          d.dot(z_axis) + 0.5F * static_cast<float>(no_depth)});
      }
      draw_mesh(mesh, points, band);
    }
  });
}

void draw_light_depths(std::span<const LightView> views, std::span<const Caster> meshes,
                       std::vector<DepthMap>& maps) {
  const std::size_t bands = views.size() < 8 ? 4 : 1;  // of a map, for few to keep the threads busy
  maps.resize(views.size());
  std::vector<SeenCaster> seen(views.size() * meshes.size());
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) {
    const LightView& view = views[i / meshes.size()];
    seen[i] = seen_from_light(meshes[i % meshes.size()], view.clip_from_world, view.size);
  });
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto size = static_cast<std::size_t>(views[i].size);
    maps[i].resize(size * size);
  }
  tbb::parallel_for(std::size_t{0}, bands * maps.size(), [&](std::size_t i) {
    const std::size_t light = i / bands;
    const int size = views[light].size, band = static_cast<int>(i % bands),
              rows = size / static_cast<int>(bands);
    DepthMap& map = maps[light];
    std::fill_n(map.begin() + static_cast<std::ptrdiff_t>(band) * rows * size,
                static_cast<std::ptrdiff_t>(rows) * size, no_depth);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      SeenCaster& caster = seen[light * meshes.size() + k];
      Caster mesh = caster.mesh;
      if (!caster.triangles.empty()) mesh.triangles = caster.triangles;
      if (!caster.points.empty())
        draw_mesh(mesh, caster.points, {map.data(), nullptr, size, band * rows, (band + 1) * rows});
    }
  });
}

}  // namespace lagomorph::render::raster
