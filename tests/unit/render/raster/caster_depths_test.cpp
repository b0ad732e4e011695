#include "render/raster/caster_depths.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <gtest/gtest.h>

#include "render/raster/light_view.h"
#include "render/raster/sky_model.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace caster_depths_test {

constexpr int size = 128;

FrameBlock frame_around(const Vec3& center, float radius) {
  FrameBlock frame{};
  frame.sky = sky_directions(Sky{});
  frame.sky_map = vec4(center, 1.0F / radius);
  return frame;
}

float middle_of(int texel) { return (2.0F * static_cast<float>(texel) + 1.0F) / size - 1.0F; }

TEST(SkyDepths, OfABallAreItsHeightTowardsTheSky) {
  const Vec3 center(0.3F, 1.0F, -0.2F);
  const Mesh ball = sphere(center, 0.5F, 96);
  std::vector<DepthMap> maps;
  draw_sky_depths(frame_around(center, 1.0F),
                  std::vector<Caster>{{ball.positions, ball.triangles, true, 1.0F, 0}}, size, maps);
  ASSERT_EQ(maps.size(), static_cast<std::size_t>(most_sky_directions));
  for (const DepthMap& map : maps) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const float across = std::hypot(middle_of(x), middle_of(y));
        const std::uint16_t depth = map[static_cast<std::size_t>(y * size + x)];
        if (across > 0.501F) {
          EXPECT_EQ(depth, no_depth);
        } else if (across < 0.48F) {  // at the rim it falls steeply
          const float height = 1.0F - 2.0F * static_cast<float>(depth) / no_depth;
          EXPECT_NEAR(height, std::sqrt(0.25F - across * across), 2e-3F);
        }
      }
    }
  }
}

TEST(SkyDepths, FromBelowAreThoseOfTheOtherSide) {
  const Vec3 center(0.3F, 1.0F, -0.2F);
  const Mesh ball = sphere(center + Vec3(0.2F, 0.1F, 0.3F), 0.4F, 96);
  const std::vector<Caster> casters = {{ball.positions, ball.triangles, true, 1.0F, 0}};
  const FrameBlock frame = frame_around(center, 1.0F);
  std::vector<DepthMap> from_above, maps;
  draw_sky_depths(frame, casters, size, from_above, &maps);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const SkyDirectionBlock& sky = frame.sky[i];
    const Vec3 off(0.2F, 0.1F, 0.3F);
    const float right = off.dot(sky.right.head<3>()), up = off.dot(sky.up.head<3>()),
                high = off.dot(sky.direction.head<3>());
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const float across = std::hypot(middle_of(x) - right, middle_of(y) - up);
        const std::uint16_t depth = maps[i][static_cast<std::size_t>(y * size + x)];
        if (across > 0.401F) {
          EXPECT_EQ(depth, no_depth);
        } else if (across < 0.38F) {
          const float height = 2.0F * static_cast<float>(depth) / no_depth - 1.0F;
          EXPECT_NEAR(height, high - std::sqrt(0.16F - across * across), 3e-3F);
        }
      }
    }
  }
}

TEST(SkyDepths, AnOpenSheetIsSeenFromBothSides) {
  // Facing down: from above only its back is seen.
  const Mesh sheet = rectangle(Vec3::Zero(), 0.4F * Vec3::UnitX(), 0.4F * Vec3::UnitZ());
  std::vector<DepthMap> open, closed;
  draw_sky_depths(frame_around(Vec3::Zero(), 1.0F),
                  std::vector<Caster>{{sheet.positions, sheet.triangles, false, 1.0F, 0}}, size, open);
  draw_sky_depths(frame_around(Vec3::Zero(), 1.0F),
                  std::vector<Caster>{{sheet.positions, sheet.triangles, true, 1.0F, 0}}, size, closed);
  const std::size_t middle = static_cast<std::size_t>(size) * (size / 2) + size / 2;
  const FrameBlock frame = frame_around(Vec3::Zero(), 1.0F);
  for (std::size_t i = 0; i < open.size(); ++i) {
    // At half a texel from the middle, along the slope.
    const float slope = 1.0F / frame.sky[i].direction[1];
    EXPECT_NEAR(static_cast<float>(open[i][middle]), 0.5F * no_depth, slope / size * no_depth);
    EXPECT_EQ(closed[i][middle], no_depth);
  }
}

TEST(SkyDepths, ASeeThroughSheetIsDotsAsDenseAsItIsOpaque) {
  const Mesh sheet = rectangle(Vec3::Zero(), 0.9F * Vec3::UnitX(), 0.9F * Vec3::UnitZ());
  const auto dots = [&](float opacity) {
    std::vector<DepthMap> maps;
    draw_sky_depths(frame_around(Vec3::Zero(), 2.0F),
                    std::vector<Caster>{{sheet.positions, sheet.triangles, false, opacity, 3}}, size, maps);
    double count = 0;
    for (const DepthMap& map : maps)
      count += static_cast<double>(
          std::count_if(map.begin(), map.end(), [](std::uint16_t d) { return d != no_depth; }));
    return count;
  };
  EXPECT_NEAR(dots(0.3F) / dots(1.0F), 0.3, 0.02);
  EXPECT_EQ(dots(0.0F), 0.0);
}

/// Looks down from `height` on what is around the origin.
AreaLight lamp(float height) {
  AreaLight light;
  light.position = Vec3(0.0F, height, 0.0F);
  light.look_at = Vec3::Zero();
  return light;
}

/// Distance along the light's axis that a step of its map stands for, see LightBlock::depth. [m]
float distance_of(const LightView& view, std::uint16_t depth) {
  return 1.0F / (view.depth[0] * static_cast<float>(depth) / no_depth + view.depth[1]);
}

std::uint16_t depth_at(const LightView& view, const DepthMap& map, int of_size, const Vec3& p) {
  const Vec4 clip = view.clip_from_world * vec4(p, 1.0F);
  const auto texel = [&](float x) {
    return static_cast<std::size_t>((x / clip.w() + 1.0F) * 0.5F * static_cast<float>(of_size));
  };
  return map[texel(clip.y()) * static_cast<std::size_t>(of_size) + texel(clip.x())];
}

TEST(LightDepths, OfABallAreItsDistanceFromTheLight) {
  const Mesh ball = sphere(Vec3::Zero(), 0.5F, 96);
  const LightView view = fit_light_view(lamp(2.0F), std::vector<std::vector<Vec3>>{ball.positions}, 512);
  std::vector<DepthMap> maps;
  draw_light_depths(std::vector{view}, std::vector<Caster>{{ball.positions, ball.triangles, true, 1.0F, 0}},
                    maps);
  for (const float x : {0.0F, 0.05F, -0.13F, 0.2F}) {
    // Where the ray from the light meets the ball.
    const Vec3 from(0.0F, 2.0F, 0.0F), to = Vec3(x, 0.0F, 0.5F * x) - from, d = to.normalized();
    const float b = from.dot(d), t = -b - std::sqrt(b * b - from.squaredNorm() + 0.25F);
    const Vec3 met = from + t * d;
    EXPECT_NEAR(distance_of(view, depth_at(view, maps[0], 512, met)), 2.0F - met.y(), 3e-3F) << x;
  }
  EXPECT_EQ(maps[0][0], no_depth);
}

/// Triangles are set up sixteen at once, of closed meshes only those that face the light.
TEST(LightDepths, OfAClosedMeshAreThoseOfAllItsTriangles) {
  const Mesh ball = sphere(Vec3(0.1F, 0.0F, -0.05F), 0.4F, 47);
  ASSERT_EQ(ball.triangles.size() % 16, 8U);
  const LightView view = fit_light_view(lamp(2.0F), std::vector<std::vector<Vec3>>{ball.positions}, 512);
  for (const std::size_t left_out : {0, 1, 7, 15}) {
    const std::span<const Triangle> triangles(ball.triangles.data(), ball.triangles.size() - left_out);
    std::vector<DepthMap> closed, sheet;
    draw_light_depths(std::vector{view}, std::vector<Caster>{{ball.positions, triangles, true, 1.0F, 0}},
                      closed);
    draw_light_depths(std::vector{view}, std::vector<Caster>{{ball.positions, triangles, false, 1.0F, 0}},
                      sheet);
    std::size_t unlike = 0, covered = 0;
    for (std::size_t i = 0; i < sheet[0].size(); ++i) {
      covered += sheet[0][i] != no_depth ? 1 : 0;
      unlike += sheet[0][i] != closed[0][i] ? 1 : 0;
    }
    EXPECT_GT(covered, 20000U);
    EXPECT_LT(unlike, 64U) << left_out;  // along the rim, where the back may be a texel wider
  }
}

TEST(LightDepths, NeighboursLeaveNoGap) {
  Mesh fine;  // a fan of slivers
  fine.positions = {Vec3(0.123F, 0.0F, 0.071F)};
  constexpr int around = 997;
  for (int i = 0; i < around; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / around;
    fine.positions.emplace_back(std::cos(angle), 0.0F, std::sin(angle));
  }
  fine.triangles.clear();
  for (std::uint32_t i = 0; i < around; ++i) fine.triangles.push_back({0, 1 + (i + 1) % around, 1 + i});
  const LightView view = fit_light_view(lamp(1.0F), std::vector<std::vector<Vec3>>{fine.positions}, 2048);
  std::vector<DepthMap> maps;
  draw_light_depths(std::vector{view}, std::vector<Caster>{{fine.positions, fine.triangles, false, 1.0F, 0}},
                    maps);
  int holes = 0;
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) {
      const Vec3 p(0.003F * static_cast<float>(x - 200), 0.0F, 0.003F * static_cast<float>(y - 200));
      holes += depth_at(view, maps[0], 2048, p) == no_depth ? 1 : 0;
    }
  }
  EXPECT_EQ(holes, 0);
}

TEST(LightDepths, WhatIsBehindTheLightIsCutOff) {
  // A wall from below the light to above it.
  const Mesh wall = rectangle(Vec3(0.0F, 0.5F, -0.4F), 1.0F * Vec3::UnitX(), 1.5F * Vec3::UnitY());
  const LightView view = fit_light_view(lamp(1.0F), std::vector<std::vector<Vec3>>{wall.positions}, 512);
  std::vector<DepthMap> maps;
  draw_light_depths(std::vector{view}, std::vector<Caster>{{wall.positions, wall.triangles, false, 1.0F, 0}},
                    maps);
  for (const float y : {0.7F, 0.4F, 0.0F, -0.5F}) {
    const Vec3 p(0.1F, y, -0.4F);
    EXPECT_NEAR(distance_of(view, depth_at(view, maps[0], 512, p)) / (1.0F - y), 1.0F, 0.03F) << y;
  }
}

TEST(LightDepths, ThereMayBeNoMesh) {
  std::vector<DepthMap> maps;
  LightView view;
  view.size = 256;
  draw_light_depths(std::vector{view}, {}, maps);
  ASSERT_EQ(maps.size(), 1U);
  EXPECT_TRUE(std::all_of(maps[0].begin(), maps[0].end(), [](std::uint16_t d) { return d == no_depth; }));
}

}  // namespace caster_depths_test
}  // namespace lagomorph::render::raster
