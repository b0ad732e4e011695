#include "render/raster/soft_shadow.h"

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "render/raster/caster_depths.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace soft_shadow_test {

constexpr int side = 64;           // receivers
constexpr float spacing = 0.002F;  // [m], finer than the map's texels

struct Lamp {
  FrameBlock frame{};
  DepthMaps maps;
};

/// A square of 0.4 m at 2 m over a ball; `alone`: it is the whole light.
Lamp lamp_over_a_ball(bool alone) {
  constexpr int map_size = 256;
  AreaLight light;
  light.position = Vec3(0.2F, 2.0F, 0.1F);
  light.look_at = Vec3::Zero();
  light.size = Vec2(0.4F, 0.4F);
  const Mesh ball = sphere(Vec3(0.0F, 0.5F, 0.0F), 0.25F, 24);
  const LightView view = fit_light_view(light, std::vector<std::vector<Vec3>>{ball.positions}, map_size);
  const LightFrame axes = light_frame(light);
  LightBlock block{};
  block.position = vec4(light.position, 1.0F);
  block.right = vec4(axes.right, 0.5F * light.size.x());
  block.up = vec4(axes.up, 0.5F * light.size.y());
  block.normal = vec4(axes.normal, 0.0F);
  block.radiance = Vec4::Ones();
  block.map = view.map;
  block.depth = view.depth;
  Lamp lamp;
  lamp.maps.lights = {{0, 1, false}};
  // Few taps of the search, so that neighbours often do not find what hides them.
  lamp.maps.parts = {{block, map_size, 1, 16, alone}};
  draw_light_depths(std::vector{view}, std::vector<Caster>{{ball.positions, ball.triangles, true, 1.0F, 0}},
                    lamp.maps.parts_maps);
  return lamp;
}

/// Points of a plane at height 0 where the shadow ends, in blocks in the order of `places`.
ReceiverBlocks on_a_plane(const std::vector<QuadPlace>& places, bool is_ground) {
  ReceiverBlocks blocks{side, side, 1, {}};
  for (const QuadPlace& at : places) {
    blocks.add(at.x, at.y, [&](int first_lane, Receivers& r) {
      r.is_ground = is_ground;
      for (int lane = first_lane; lane < first_lane + quad; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        r.there[l] = 1;
        r.point.set(lane, Vec3(0.3F, 0.0F, 0.0F) +
                              spacing * Vec3(static_cast<float>(at.x + (lane & 1) - side / 2), 0.0F,
                                             static_cast<float>(at.y + row(lane) - side / 2)));
        r.depth[l] = 2.0F;
        r.footprint[l] = spacing;
      }
      return true;
    });
  }
  return blocks;
}

std::vector<float> seen_by(const Lamp& lamp, const std::vector<QuadPlace>& places, bool is_ground) {
  const ReceiverBlocks at = on_a_plane(places, is_ground);
  std::vector<Lanes> seen;
  std::vector<LaneBits> hard(at.blocks.size());
  soft_shadow(lamp.frame, lamp.maps, 0, at, seen, hard);
  std::vector<float> by_place(static_cast<std::size_t>(side) * side);
  for (std::size_t b = 0; b < at.blocks.size(); ++b) {
    at.blocks[b].for_lanes([&](std::size_t lane, int x, int y) {
      by_place[static_cast<std::size_t>(y * side + x)] = seen[b][lane];
    });
  }
  return by_place;
}

std::vector<QuadPlace> row_by_row() {
  std::vector<QuadPlace> places;
  for (int y = 0; y < side; y += 2) {
    for (int x = 0; x < side; x += 2) places.push_back({x, y});
  }
  return places;
}

/// So that a region is the whole picture's to the bit, and the same quads may be put into any blocks.
TEST(SoftShadow, OfAQuadIsTheSameWhateverItsCompanions) {
  for (const bool is_ground : {false, true}) {
    for (const bool alone : {false, true}) {
      const Lamp lamp = lamp_over_a_ball(alone);
      std::vector<QuadPlace> places = row_by_row();
      const std::vector<float> expected = seen_by(lamp, places, is_ground);
      const auto half = std::count_if(expected.begin(), expected.end(),
                                      [](float part) { return part > 0.05F && part < 0.95F; });
      EXPECT_GT(half, 200);  // a penumbra
      EXPECT_EQ(*std::max_element(expected.begin(), expected.end()), 1.0F);
      std::mt19937 random(7);
      for (int round = 0; round < 3; ++round) {
        std::shuffle(places.begin(), places.end(), random);
        EXPECT_TRUE(seen_by(lamp, places, is_ground) == expected) << is_ground << alone << round;
      }
    }
  }
}

}  // namespace soft_shadow_test
}  // namespace lagomorph::render::raster
