#include "render/raster/coarse_parts.h"

#include <array>

#include <gtest/gtest.h>

namespace lagomorph::render::raster {
namespace {

constexpr int step = 4;
using Cells = CoarseParts<1, step>;

constexpr int width = 8, height = 2;  // cells

/// Cells of a plane at depth 1 that looks at the viewer; those from `edge` on are of another.
ReceiverBlocks cells_of_a_plane(int edge = width, const Vec3& other_normal = Vec3::UnitZ(),
                                float other_depth = 1.0F) {
  ReceiverBlocks cells{width, height, step, {}};
  for (int x = 0; x < width; x += 2) {
    cells.add(x, 0, [&](int first_lane, Receivers& r) {
      for (int lane = first_lane; lane < first_lane + quad; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        const bool other = x + (lane & 1) >= edge;
        r.there[l] = 1;
        r.normal.set(lane, other ? other_normal : Vec3::UnitZ());
        r.depth[l] = other ? other_depth : 1.0F;
      }
      return true;
    });
  }
  return cells;
}

/// Parts by the cell's column.
Cells filled(const ReceiverBlocks& receivers, const std::array<float, width>& parts) {
  Cells cells(receivers);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) cells.at(x, y)[0] = parts[static_cast<std::size_t>(x)];
  }
  cells.finish(receivers, {0.1F, true}, std::vector<LaneBits>(receivers.blocks.size()));
  return cells;
}

float found(const Cells& cells, int x, float depth = 1.0F, const Vec3& normal = Vec3::UnitZ()) {
  Cells::Parts seen;
  return cells.find(
             x, 1, depth, [&] { return normal; }, 0.1F, seen)
             ? seen[0]
             : -1.0F;
}

TEST(CoarseParts, AreBilinearBetweenCells) {
  const Cells cells = filled(cells_of_a_plane(), {0.5F, 0.58F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F});
  EXPECT_FLOAT_EQ(found(cells, 0), 0.5F);
  EXPECT_FLOAT_EQ(found(cells, 1), 0.52F);
  EXPECT_FLOAT_EQ(found(cells, 4), 0.58F);
  EXPECT_FLOAT_EQ(found(cells, 7), 0.52F);
}

TEST(CoarseParts, WhereAllIsSeenAreOpen) {
  const Cells cells = filled(cells_of_a_plane(), {1.0F, 1.0F, 1.0F, 0.95F, 1.0F, 1.0F, 1.0F, 1.0F});
  EXPECT_TRUE(cells.is_open(3, 0));
  EXPECT_FALSE(cells.is_open(2 * step, 0));  // its neighbour is not
  EXPECT_EQ(found(cells, 3), 1.0F);
}

TEST(CoarseParts, DoNotSayWhatANarrowEdgeHides) {
  const Cells cells = filled(cells_of_a_plane(), {1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F});
  EXPECT_EQ(found(cells, step), 1.0F);
  for (int x = 2 * step; x < 3 * step; ++x) EXPECT_EQ(found(cells, x), -1.0F);
  EXPECT_EQ(found(cells, 3 * step), 0.0F);
}

TEST(CoarseParts, DoNotSayWhatIsBesideAHardEdge) {
  const ReceiverBlocks receivers = cells_of_a_plane();
  Cells cells(receivers);  // all is seen
  // The lower right receiver of the first quad, in column 1.
  std::vector<LaneBits> hard(receivers.blocks.size());
  hard[0] = 1U << 1U;
  cells.finish(receivers, {0.1F, true}, hard);
  for (int x = 0; x < 2 * step; ++x) EXPECT_EQ(found(cells, x), -1.0F) << x;
  EXPECT_EQ(found(cells, 2 * step), 1.0F);
}

TEST(CoarseParts, DoNotSayWhereAShadowIsDarkBesideANarrowEdge) {
  const Cells cells = filled(cells_of_a_plane(), {1.0F, 1.0F, 0.96F, 0.5F, 0.04F, 0.0F, 0.0F, 0.0F});
  EXPECT_FLOAT_EQ(found(cells, step + 2), 0.98F);
  for (int x = 2 * step; x < 5 * step; ++x) EXPECT_EQ(found(cells, x), -1.0F) << x;
  EXPECT_EQ(found(cells, 5 * step), 0.0F);
}

TEST(CoarseParts, AreThoseOfTheOwnSurface) {
  const std::array<float, width> parts = {0.5F, 0.5F, 0.58F, 0.58F, 0.58F, 0.58F, 0.58F, 0.58F};
  for (const ReceiverBlocks& receivers :
       {cells_of_a_plane(2, Vec3::UnitX()), cells_of_a_plane(2, Vec3::UnitZ(), 2.0F)}) {
    const Cells cells = filled(receivers, parts);
    const Vec3 other = receivers.blocks[0].at.normal.at(lanes - 1);
    const float depth = receivers.blocks[0].at.depth[lanes - 1];
    EXPECT_FLOAT_EQ(found(cells, 6), 0.5F);
    EXPECT_FLOAT_EQ(found(cells, 6, depth, other), 0.58F);
    EXPECT_EQ(found(cells, 6, 5.0F), -1.0F);  // of neither
  }
}

TEST(CoarseParts, DoNotAskForTheNormalWhereTheirCornersAreAlike) {
  const std::array<float, width> parts = {0.5F, 0.58F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F};
  int asked = 0;
  const auto normal = [&] {
    ++asked;
    return Vec3(Vec3::UnitX());
  };
  Cells::Parts seen;
  const Cells plane = filled(cells_of_a_plane(), parts);
  ASSERT_TRUE(plane.find(2, 1, 1.05F, normal, 0.1F, seen));
  EXPECT_FLOAT_EQ(seen[0], 0.54F);
  EXPECT_EQ(asked, 0);
  EXPECT_FALSE(plane.find(2, 1, 1.2F, normal, 0.1F, seen));  // too deep for all four
  EXPECT_EQ(asked, 1);
  const Cells edge = filled(cells_of_a_plane(1, Vec3::UnitX()), parts);
  ASSERT_TRUE(edge.find(2, 1, 1.0F, normal, 0.1F, seen));
  EXPECT_FLOAT_EQ(seen[0], 0.58F);
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace lagomorph::render::raster
