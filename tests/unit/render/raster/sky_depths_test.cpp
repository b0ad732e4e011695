#include "render/raster/sky_depths.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "render/raster/sky_model.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace sky_depths_test {

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
                  std::vector<SkyCaster>{{ball.positions, ball.triangles, true, 1.0F, 0}}, size, maps);
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

TEST(SkyDepths, AnOpenSheetIsSeenFromBothSides) {
  // Facing down: from above only its back is seen.
  const Mesh sheet = rectangle(Vec3::Zero(), 0.4F * Vec3::UnitX(), 0.4F * Vec3::UnitZ());
  std::vector<DepthMap> open, closed;
  draw_sky_depths(frame_around(Vec3::Zero(), 1.0F),
                  std::vector<SkyCaster>{{sheet.positions, sheet.triangles, false, 1.0F, 0}}, size, open);
  draw_sky_depths(frame_around(Vec3::Zero(), 1.0F),
                  std::vector<SkyCaster>{{sheet.positions, sheet.triangles, true, 1.0F, 0}}, size, closed);
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
                    std::vector<SkyCaster>{{sheet.positions, sheet.triangles, false, opacity, 3}}, size,
                    maps);
    double count = 0;
    for (const DepthMap& map : maps)
      count += static_cast<double>(
          std::count_if(map.begin(), map.end(), [](std::uint16_t d) { return d != no_depth; }));
    return count;
  };
  EXPECT_NEAR(dots(0.3F) / dots(1.0F), 0.3, 0.02);
  EXPECT_EQ(dots(0.0F), 0.0);
}

}  // namespace sky_depths_test
}  // namespace lagomorph::render::raster
