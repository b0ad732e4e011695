#include "render/raster/receivers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "render/raster/half.h"
#include "render/raster/pixel_ray.h"

namespace lagomorph::render::raster {
namespace {

/// Two fractions in [-1, 1], see packSnorm2x16.
Vec2 unpacked(std::uint32_t bits) {
  const auto part = [](std::uint32_t half) {
    return std::max(static_cast<float>(static_cast<std::int16_t>(half & 0xffffU)) / 32767.0F, -1.0F);
  };
  return {part(bits), part(bits >> 16U)};
}

/// As direction_of() of the shaders [Meyer et al. 2010].
Vec3 direction_of(const Vec2& p) {
  Vec3 n(p.x(), p.y(), 1.0F - std::abs(p.x()) - std::abs(p.y()));
  if (n.z() < 0.0F) {
    n.x() = std::copysign(1.0F - std::abs(p.y()), p.x());
    n.y() = std::copysign(1.0F - std::abs(p.x()), p.y());
  }
  return n.normalized();
}

/// As mirrored_view() of the shaders.
Vec3 mirrored_view(const Vec3& v, const Vec3& normal) {
  constexpr float least = 1e-3F;
  const float cosine = normal.dot(v);
  const Vec3 n = cosine < least ? Vec3((normal + (least - cosine) * v).normalized()) : normal;
  return 2.0F * n.dot(v) * n - v;
}

void clear(Receivers& r, int lane) {
  const auto l = static_cast<std::size_t>(lane);
  r.there[l] = 0;
  r.point.set(lane, Vec3::Zero());
  for (Lanes3* n : {&r.normal, &r.mirrored}) n->set(lane, Vec3::UnitY());
  r.raised[l] = 0.0F;
  r.roughness[l] = 1.0F;
  r.depth[l] = 1e9F;  // unlike any neighbour's
  r.footprint[l] = 1.0F;
}

/// A point of the ground; all see the same plane.
void put_ground(Receivers& r, int lane, const Vec3& point, float normal_y, float footprint) {
  r.is_ground = true;
  const auto l = static_cast<std::size_t>(lane);
  r.there[l] = 1;
  r.point.set(lane, point);
  for (Lanes3* n : {&r.normal, &r.mirrored}) n->set(lane, Vec3(0.0F, normal_y, 0.0F));
  r.depth[l] = 0.0F;
  r.footprint[l] = footprint;
}

/// The first point of a cell of step x step pixels where one is, from its lower left pixel on.
template <class Point>
auto first_of(int x, int y, int step, const Point& point) -> decltype(point(x, y)) {
  for (int j = 0; j < step; ++j) {
    for (int i = 0; i < step; ++i) {
      if (auto found = point(x + i, y + j)) return found;
    }
  }
  return {};
}

}  // namespace

void ReceiverBlocks::begin_block() {
  // What is left of a last one stays: no neighbour is like it.
  blocks.emplace_back();
  for (int lane = 0; lane < lanes; ++lane) clear(blocks.back().at, lane);
}

float pixel_footprint(const FrameBlock& frame, float depth) {
  return 2.0F * frame.up.head<3>().norm() * frame.viewport[3] * (frame.eye.w() > 0.5F ? 1.0F : depth);
}

Vec3 normal_of(const SurfaceTexel& texel) { return direction_of(unpacked(texel.normal)); }

bool ground_receivers(const FrameBlock& frame, int x, int y, int step, int first_lane, Receivers& r) {
  const float normal_y = ground_is_below(frame) ? 1.0F : -1.0F;
  bool any = false;
  for (int lane = first_lane; lane < first_lane + quad; ++lane) {
    clear(r, lane);
    const int right = step * (lane & 1), above = step * row(lane);
    const std::optional<GroundPoint> ground = first_of(x + right, y + above, step, [&](int px, int py) {
      return ground_at_pixel(frame, static_cast<float>(px) + 0.5F, static_cast<float>(py) + 0.5F);
    });
    if (!ground) continue;
    put_ground(r, lane, ground->point, normal_y, pixel_footprint(frame, ground->depth));
    any = true;
  }
  return any;
}

bool ground_map_receivers(const FrameBlock& frame, int x, int y, int step, int first_lane, Receivers& r) {
  const Vec4& map = frame.ground_map;
  for (int lane = first_lane; lane < first_lane + quad; ++lane) {
    clear(r, lane);
    const int right = step * (lane & 1), above = step * row(lane);
    const Vec2 at =
        Vec2(static_cast<float>(x + right) + 0.5F, static_cast<float>(y + above) + 0.5F) / frame.counts[3];
    put_ground(r, lane, Vec3((at.x() - map[2]) / map[0], frame.ground.x(), (at.y() - map[3]) / map[0]), 1.0F,
               map[1]);
  }
  return true;
}

bool surface_receivers(const FrameBlock& frame, const SurfaceTexels& surfaces, int x, int y, int step,
                       int first_lane, Receivers& r) {
  struct Found {
    const SurfaceTexel* texel = nullptr;
    int x = 0, y = 0;
    explicit operator bool() const { return texel != nullptr; }
  };
  bool any = false;
  for (int lane = first_lane; lane < first_lane + quad; ++lane) {
    clear(r, lane);
    const int right = step * (lane & 1), above = step * row(lane);
    const Found found = first_of(x + right, y + above, step, [&](int px, int py) {
      return Found{surfaces.find(px, py), px, py};
    });
    if (!found) continue;
    any = true;
    const SurfaceTexel& t = *found.texel;
    const auto l = static_cast<std::size_t>(lane);
    const PixelRay ray = pixel_ray(frame, static_cast<float>(surfaces.at.x + found.x) + 0.5F,
                                   static_cast<float>(surfaces.at.y + found.y) + 0.5F);
    const auto depth = std::bit_cast<float>(t.depth);
    r.there[l] = 1;
    r.point.set(lane, ray.origin + depth * ray.direction);
    const Vec3 normal = normal_of(t);
    r.normal.set(lane, normal);
    r.mirrored.set(lane, mirrored_view(-ray.direction.normalized(), normal));
    r.roughness[l] = static_cast<float>(t.lit() - 1U) / 65534.0F;
    r.raised[l] = from_half(static_cast<std::uint16_t>(t.raised & 0xffffU));
    r.depth[l] = depth;
    r.footprint[l] = pixel_footprint(frame, depth);
  }
  return any;
}

}  // namespace lagomorph::render::raster
