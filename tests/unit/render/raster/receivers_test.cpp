#include "render/raster/receivers.h"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace lagomorph::render::raster {
namespace {

/// Quads in a row; those at an odd place are not there.
ReceiverBlocks every_other(int count) {
  ReceiverBlocks blocks{2 * count, 2, 1, {}};
  for (int k = 0; k < count; ++k) {
    blocks.add(2 * k, 0, [&](int first_lane, Receivers& r) {
      if (k % 2 != 0) return false;
      for (int lane = first_lane; lane < first_lane + quad; ++lane) {
        r.there[static_cast<std::size_t>(lane)] = 1;
        r.depth[static_cast<std::size_t>(lane)] = static_cast<float>(k);
      }
      return true;
    });
  }
  return blocks;
}

TEST(ReceiverBlocks, HaveNoLanesForQuadsThatAreNotThere) {
  const ReceiverBlocks blocks = every_other(11);  // six quads
  ASSERT_EQ(blocks.blocks.size(), 2U);
  EXPECT_EQ(blocks.blocks[0].used, quads);
  EXPECT_EQ(blocks.blocks[1].used, 2);
  for (const ReceiverBlock& block : blocks.blocks) {
    int lanes_there = 0;
    block.for_lanes([&](std::size_t lane, int x, int y) {
      EXPECT_EQ(block.at.there[lane], 1);
      EXPECT_EQ(static_cast<int>(block.at.depth[lane]), x / 2) << y;
      ++lanes_there;
    });
    EXPECT_EQ(lanes_there, quad * block.used);
  }
  for (int lane = 2 * quad; lane < lanes; ++lane)
    EXPECT_EQ(blocks.blocks[1].at.there[static_cast<std::size_t>(lane)], 0) << lane;
}

TEST(ReceiverBlocks, AreEmptyWhereNothingIs) {
  ReceiverBlocks blocks{2, 2, 1, {}};
  EXPECT_TRUE(blocks.empty());
  blocks.add(0, 0, [](int, Receivers&) { return false; });
  EXPECT_TRUE(blocks.empty());
  EXPECT_FALSE(every_other(1).empty());
}

TEST(ReceiverBlocks, OfSurfacesKnowTheirPixels) {
  constexpr int width = 4, height = 2;
  std::vector<SurfaceTexel> texels(static_cast<std::size_t>(width) * height);
  // One pixel: at depth 2, raised by 1/4, half rough, of the surface 7 in three samples.
  texels[width + 2] = {0x40000000U, 0U, 7U << 16U | 0x3400U, 3U << 16U | 32768U};
  const SurfaceTexels surfaces{{0, 0, width, height}, texels};
  FrameBlock frame{};
  frame.viewport = Vec4(width, height, 1.0F / width, 1.0F / height);
  Receivers r;
  EXPECT_FALSE(surface_receivers(frame, surfaces, 0, 0, 1, 0, r));
  ASSERT_TRUE(surface_receivers(frame, surfaces, 2, 0, 1, quad, r));
  const std::size_t there = quad + 2;  // upper left of its quad
  for (std::size_t lane = quad; lane < 2 * quad; ++lane) EXPECT_EQ(r.there[lane], lane == there ? 1 : 0);
  EXPECT_EQ(r.depth[there], 2.0F);
  EXPECT_EQ(r.raised[there], 0.25F);
  EXPECT_NEAR(r.roughness[there], 0.5F, 1e-4F);
}

}  // namespace
}  // namespace lagomorph::render::raster
