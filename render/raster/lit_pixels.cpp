#include "render/raster/lit_pixels.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/raster/pixel_block.h"
#include "render/raster/pixel_ray.h"
#include "render/raster/sky_visibility.h"
#include "render/raster/soft_shadow.h"

namespace lagomorph::render::raster {
namespace {

constexpr Parts whole = {65535, 65535, 65535, 65535};

std::uint16_t fraction(float x) {
  return static_cast<std::uint16_t>(std::clamp(x * 65535.0F + 0.5F, 0.0F, 65535.0F));
}

/// As pixel_footprint() of the shaders.
float pixel_footprint(const FrameBlock& frame, float depth) {
  return 2.0F * frame.up.head<3>().norm() * frame.viewport[3] * (frame.eye.w() > 0.5F ? 1.0F : depth);
}

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

/// Returns whether any is in the block.
bool ground_receivers(const FrameBlock& frame, int x, int y, Receivers& r) {
  bool any = false;
  for (int lane = 0; lane < lanes; ++lane) {
    clear(r, lane);
    const std::optional<GroundPoint> ground = ground_at_pixel(
        frame, static_cast<float>(x + column(lane)) + 0.5F, static_cast<float>(y + row(lane)) + 0.5F);
    if (!ground) continue;
    const bool above = frame.eye.w() > 0.5F ? frame.forward.y() < 0.0F : frame.eye.y() > ground->point.y();
    put_ground(r, lane, ground->point, above ? 1.0F : -1.0F, pixel_footprint(frame, ground->depth));
    any = true;
  }
  return any;
}

void ground_map_receivers(const FrameBlock& frame, int x, int y, Receivers& r) {
  const Vec4& map = frame.ground_map;
  for (int lane = 0; lane < lanes; ++lane) {
    clear(r, lane);
    const Vec2 at =
        Vec2(static_cast<float>(x + column(lane)) + 0.5F, static_cast<float>(y + row(lane)) + 0.5F) /
        frame.counts[3];
    put_ground(r, lane, Vec3((at.x() - map[2]) / map[0], frame.ground.x(), (at.y() - map[3]) / map[0]), 1.0F,
               map[1]);
  }
}

/// Returns false where no surface is in the block.
bool surface_receivers(const FrameBlock& frame, bool with_mirrored, const PixelRectangle& rectangle,
                       std::span<const SurfaceTexel> texels, int x, int y, Receivers& r) {
  bool any = false;
  for (int lane = 0; lane < lanes; ++lane) {
    clear(r, lane);
    const int px = x + column(lane), py = y + row(lane);
    const SurfaceTexel& t = texels[static_cast<std::size_t>(py) * static_cast<std::size_t>(rectangle.width) +
                                   static_cast<std::size_t>(px)];
    if (t.finish == 0) continue;
    any = true;
    const auto l = static_cast<std::size_t>(lane);
    const PixelRay ray = pixel_ray(frame, static_cast<float>(rectangle.x + px) + 0.5F,
                                   static_cast<float>(rectangle.y + py) + 0.5F);
    const auto depth = std::bit_cast<float>(t.depth);
    r.there[l] = 1;
    r.point.set(lane, ray.origin + depth * ray.direction);
    const Vec3 normal = direction_of(unpacked(t.normal));
    r.normal.set(lane, normal);
    if (with_mirrored) r.mirrored.set(lane, mirrored_view(-ray.direction.normalized(), normal));
    r.roughness[l] = static_cast<float>(t.finish - 1U) / 65534.0F;
    r.raised[l] = std::bit_cast<float>(t.raised);
    r.depth[l] = depth;
    r.footprint[l] = pixel_footprint(frame, depth);
  }
  return any;
}

/// Rectangles of whole blocks around `part` with a block more to all sides, for neighbours of its pixels to
/// be there; receivers(x, y, r) puts those of the block at a corner, and says whether anything is there.
template <class BlockReceivers>
ReceiverBlocks receivers_around(const PixelRectangle& part, const BlockReceivers& receivers) {
  ReceiverBlocks all;
  all.resize(part.width / block_width + 2, part.height / block_height + 2);
  for (int k = 0; k < all.rows * all.columns; ++k) {
    const int x = part.x + (k % all.columns - 1) * block_width,
              y = part.y + (k / all.columns - 1) * block_height;
    const auto i = static_cast<std::size_t>(k);
    all.empty[i] = receivers(x, y, all.blocks[i]) ? 0 : 1;
  }
  return all;
}

/// Calls block(x, y, receivers) for those of the part itself that are not empty.
template <class Block>
void for_blocks_of(const PixelRectangle& part, const ReceiverBlocks& receivers, const Block& block) {
  for (int j = 1; j < receivers.rows - 1; ++j) {
    for (int i = 1; i < receivers.columns - 1; ++i) {
      const auto k = static_cast<std::size_t>(j * receivers.columns + i);
      if (receivers.empty[k] == 0)
        block(part.x + (i - 1) * block_width, part.y + (j - 1) * block_height, receivers.blocks[k]);
    }
  }
}

/// Calls part() for bands of a rectangle of whole blocks, on all threads.
template <class Part>
void for_bands(int width, int height, const Part& part) {
  constexpr int most = 32;  // rows, over which a block more to both sides is little
  tbb::parallel_for(0, (height + most - 1) / most, [&](int k) {
    part(PixelRectangle{0, k * most, width, std::min(most, height - k * most)});
  });
}

std::size_t pixel_of(const PixelRectangle& at, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(at.width) + static_cast<std::size_t>(x);
}

/// Those lights whose bit is set, of the part in the middle of its receivers.
void put_lights(const FrameBlock& frame, const DepthMaps& maps, const ReceiverBlocks& receivers,
                std::uint32_t which, const PixelRectangle& part, LitPixels& lit) {
  std::vector<float> seen;
  for (std::size_t i = 0; i < maps.lights.size(); ++i) {
    if ((which >> i & 1U) == 0) continue;
    soft_shadow(frame, maps, static_cast<int>(i), receivers, seen);
    for (int y = 0; y < part.height; ++y) {
      const float* from = seen.data() + (y + block_height) * receivers.width() + block_width;
      Parts* to = lit.lights.data() + pixel_of(lit.at, part.x, part.y + y);
      for (int x = 0; x < part.width; ++x) to[x][i] = fraction(from[x]);
    }
  }
}

void put_sky(const Lanes3& seen, const PixelRectangle& at, int x, int y, std::vector<Parts>& parts) {
  for (int lane = 0; lane < lanes; ++lane) {
    const Vec3 v = seen.at(lane);
    parts[pixel_of(at, x + column(lane), y + row(lane))] = {fraction(v.x()), fraction(v.y()), fraction(v.z()),
                                                            65535};
  }
}

std::size_t area(const PixelRectangle& r) {
  return static_cast<std::size_t>(r.width) * static_cast<std::size_t>(r.height);
}

constexpr std::uint32_t all_lights = ~0U;

}  // namespace

PixelRectangle whole_blocks(const PixelRectangle& r) {
  const auto down = [](int x, int step) { return x / step * step; };
  const auto up = [](int x, int step) { return (x + step - 1) / step * step; };
  const int x = down(r.x, block_width), y = down(r.y, block_height);
  return {x, y, up(r.x + r.width, block_width) - x, up(r.y + r.height, block_height) - y};
}

void light_ground(const FrameBlock& frame, const DepthMaps& maps, std::span<const TileRun> runs,
                  LitPixels& lit) {
  int left = 1 << 30, lower = left, right = 0, upper = 0;
  for (const TileRun& run : runs) {
    if (run.lights_hidden == 0) continue;
    left = std::min(left, static_cast<int>(run.left));
    lower = std::min(lower, static_cast<int>(run.lower));
    right = std::max(right, static_cast<int>(run.right));
    upper = std::max(upper, static_cast<int>(run.upper));
  }
  lit.at = right > left ? PixelRectangle{left, lower, right - left, upper - lower} : PixelRectangle{};
  lit.lights.assign(area(lit.at), whole);
  lit.diffuse.clear();
  lit.mirrored.clear();
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
    const TileRun& run = runs[k];
    if (run.lights_hidden == 0) return;
    PixelRectangle part{static_cast<int>(run.left), static_cast<int>(run.lower),
                        static_cast<int>(run.right - run.left), static_cast<int>(run.upper - run.lower)};
    const ReceiverBlocks receivers =
        receivers_around(part, [&](int x, int y, Receivers& r) { return ground_receivers(frame, x, y, r); });
    part.x -= lit.at.x, part.y -= lit.at.y;
    put_lights(frame, maps, receivers, run.lights_hidden, part, lit);
  });
}

bool light_surfaces(const FrameBlock& frame, const DepthMaps& maps, const PixelRectangle& rectangle,
                    std::span<const SurfaceTexel> texels, LitPixels& lit) {
  if (std::all_of(texels.begin(), texels.end(), [](const SurfaceTexel& t) { return t.depth == 0; }))
    return false;
  lit.at = rectangle;
  for (std::vector<Parts>* parts : {&lit.lights, &lit.diffuse}) parts->resize(area(rectangle));
  lit.mirrored.resize(maps.sky_is_map ? area(rectangle) : 0);
  for_bands(rectangle.width, rectangle.height, [&](const PixelRectangle& band) {
    const ReceiverBlocks receivers = receivers_around(band, [&](int x, int y, Receivers& r) {
      const bool inside =
          x >= 0 && y >= 0 && x + block_width <= rectangle.width && y + block_height <= rectangle.height;
      return inside && surface_receivers(frame, maps.sky_is_map, rectangle, texels, x, y, r);
    });
    put_lights(frame, maps, receivers, all_lights, band, lit);
    for_blocks_of(band, receivers, [&](int x, int y, const Receivers& r) {
      SkySeen seen;
      sky_seen(frame, maps, r, seen);
      put_sky(seen.diffuse, rectangle, x, y, lit.diffuse);
      if (maps.sky_is_map) put_sky(seen.mirrored, rectangle, x, y, lit.mirrored);
    });
  });
  return true;
}

void light_ground_map(const FrameBlock& frame, const DepthMaps& maps, LitPixels& lit) {
  const int size = static_cast<int>(frame.counts[3]);
  lit.at = {0, 0, size, size};
  lit.lights.assign(area(lit.at), whole);
  lit.diffuse.resize(area(lit.at));
  lit.mirrored.clear();
  for_bands(size, size, [&](const PixelRectangle& band) {
    const ReceiverBlocks receivers = receivers_around(band, [&](int x, int y, Receivers& r) {
      ground_map_receivers(frame, x, y, r);
      return true;
    });
    put_lights(frame, maps, receivers, all_lights, band, lit);
    for_blocks_of(band, receivers, [&](int x, int y, const Receivers& r) {
      SkySeen seen;
      sky_seen_softly(frame, maps, r, seen);
      put_sky(seen.diffuse, lit.at, x, y, lit.diffuse);
    });
  });
}

}  // namespace lagomorph::render::raster
