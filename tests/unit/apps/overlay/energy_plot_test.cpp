#include "apps/overlay/energy_plot.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace energy_plot_test {

constexpr int width = 640, height = 360;

const EnergyAxes axes{.time = {0.0, 2.0}, .energy = {-5.0, 20.0}};

std::vector<EnergySample> samples(int count) {
  std::vector<EnergySample> all;
  for (int i = 0; i < count; ++i) {
    const double t = 0.1 * i;
    all.push_back({t, 2.0 * t, 4.0 * t, 20.0 - 10.0 * t, 20.0 - 4.0 * t});
  }
  return all;
}

void draw_plot(render::Picture& picture, const std::vector<EnergySample>& shown, const EnergyAxes& ranges,
               const std::string& place) {
  OverlayLayout layout(picture.width, picture.height);
  if (const auto plate = place_energy_plot(layout, ranges, place))
    draw_energy_plot(picture, shown, ranges, *plate);
}

render::Picture plot(int count, const std::string& place) {
  render::Picture picture{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, 128)};
  draw_plot(picture, samples(count), axes, place);
  return picture;
}

struct Extent {
  int left = width, right = -1, top = height, bottom = -1;
};
Extent extent(const render::Picture& a, const render::Picture& b) {
  Extent e;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * width + x));
      if (std::equal(&a.rgb[at], &a.rgb[at] + 3, &b.rgb[at])) continue;
      e = {std::min(e.left, x), std::max(e.right, x), std::min(e.top, y), std::max(e.bottom, y)};
    }
  }
  return e;
}

TEST(EnergyPlot, StandsInItsCorner) {
  render::Picture plain{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, 128)};
  for (const std::string place : {"top_left", "top_right", "bottom_left", "bottom_right"}) {
    const Extent e = extent(plain, plot(5, place));
    ASSERT_GT(e.right, e.left) << place;
    EXPECT_EQ(e.right < width / 2, place.ends_with("left")) << place;
    EXPECT_EQ(e.bottom < height / 2 + 20, place.starts_with("top")) << place;
  }
}

/// Later frames draw more to the right of the same diagram.
TEST(EnergyPlot, GrowsAndKeepsItsAxes) {
  const Extent more = extent(plot(5, "top_left"), plot(15, "top_left"));
  const Extent all = extent(plot(1, "top_left"), plot(15, "top_left"));
  EXPECT_GT(more.left, all.left + 10);
  EXPECT_EQ(more.right, all.right);
  // Up to 1.4 s of 2 s.
  const Extent to_the_end = extent(plot(1, "top_left"), plot(21, "top_left"));
  const double full = to_the_end.right - to_the_end.left;
  EXPECT_NEAR((all.right - all.left) / full, 0.7, 0.05);
}

/// Its letters have a least size, so that small pictures' plates are wider.
TEST(EnergyPlot, TheLegendHasRoomInSmallPictures) {
  render::Picture small{480, 270, std::vector<std::uint8_t>(std::size_t{3} * 480 * 270, 128)};
  const render::Picture before = small;
  draw_plot(small, samples(5), axes, "top_right");
  ASSERT_NE(small.rgb, before.rgb);
  const int border = 480 - static_cast<int>(3.0 * 2.7);
  for (int y = 0; y < 270; ++y) {
    for (int x = border + 1; x < 480; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * 480 + x));
      ASSERT_EQ(small.rgb[at], before.rgb[at]) << x << " " << y;
    }
  }
}

TEST(EnergyPlot, IsNotDrawnWhereThereIsNoRoom) {
  render::Picture small{60, 40, std::vector<std::uint8_t>(std::size_t{3} * 60 * 40, 128)};
  const render::Picture before = small;
  draw_plot(small, samples(5), axes, "top_left");
  EXPECT_EQ(small.rgb, before.rgb);
}

/// Pixels of about a colour.
int count_of(const render::Picture& p, int r, int g, int b) {
  int count = 0;
  for (std::size_t i = 0; i < p.rgb.size(); i += 3)
    count += std::abs(p.rgb[i] - r) + std::abs(p.rgb[i + 1] - g) + std::abs(p.rgb[i + 2] - b) < 40 ? 1 : 0;
  return count;
}

render::Picture plot_of(const EnergyAxes& shown) {
  render::Picture picture{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, 128)};
  draw_plot(picture, samples(21), shown, "top_left");
  return picture;
}

TEST(EnergyPlot, DrawsOnlyTheCurvesThatAreAskedFor) {
  EnergyAxes some = axes;
  some.curves = {"elastic"};
  const render::Picture all = plot_of(axes), one = plot_of(some);
  EXPECT_GT(count_of(all, 86, 180, 233), 50) << "kinetic, with its sample in the legend";
  EXPECT_EQ(count_of(one, 86, 180, 233), 0);
  EXPECT_EQ(count_of(one, 64, 200, 150), 0) << "gravity";
  EXPECT_GT(count_of(one, 230, 159, 0), 50) << "elastic";
  some.curves = {"elastic", "kinetic"};
  EnergyAxes other = some;
  std::reverse(other.curves.begin(), other.curves.end());
  EXPECT_EQ(plot_of(some).rgb, plot_of(other).rgb) << "the legend has its own order";
}

/// A curve that leaves the range is cut off there, not drawn along the border.
TEST(EnergyPlot, AGivenRangeCutsCurvesOff) {
  EnergyAxes given = {.time = {0.0, 2.0}, .energy = {0.0, 4.0}, .given = true, .curves = {"kinetic"}};
  const int whole = count_of(plot_of(given), 86, 180, 233);  // 2 t, up to 4 J
  given.energy = {0.0, 2.0};
  const int half = count_of(plot_of(given), 86, 180, 233);  // leaves it after half the time
  given.energy = {100.0, 200.0};
  const int none = count_of(plot_of(given), 86, 180, 233);
  EXPECT_GT(none, 0) << "of the legend";
  EXPECT_LT(none, whole / 3);
  EXPECT_LT(half, whole - 20);
  EXPECT_GT(half, none + 20);
}

TEST(EnergyPlot, OneEnergyForAllTimeIsDrawn) {
  render::Picture picture{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, 128)};
  const render::Picture before = picture;
  draw_plot(picture, {{0.0, 0.0, 0.0, 0.0, 0.0}}, {.time = {0.0, 1.0}, .energy = {0.0, 0.0}}, "top_left");
  EXPECT_NE(picture.rgb, before.rgb);
}

}  // namespace energy_plot_test
}  // namespace lagomorph::apps
