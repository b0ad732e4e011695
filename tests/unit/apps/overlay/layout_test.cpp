#include "apps/overlay/layout.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "apps/overlay/caption.h"
#include "apps/overlay/color_bar.h"
#include "apps/overlay/energy_plot.h"

namespace lagomorph::apps {
namespace layout_test {

bool apart_and_inside(const OverlayLayout& layout) {
  const std::vector<Rectangle>& all = layout.taken();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Rectangle& r = all[i];
    if (r.left < 0 || r.top < 0 || r.right > layout.width() || r.bottom > layout.height()) return false;
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(r, all[j])) return false;
  }
  return true;
}

TEST(OverlayLayout, WhatIsAloneStandsAtItsPlace) {
  struct Case {
    const char* place;
    double left, top;
  };
  const Case cases[] = {{"top_left", 11, 11},     {"top", 270, 11},     {"top_right", 529, 11},
                        {"bottom_left", 11, 309}, {"bottom", 270, 309}, {"bottom_right", 529, 309},
                        {"right", 529, 160}};
  for (const Case& c : cases) {
    OverlayLayout layout(640, 360);  // margins of 3 %
    const Rectangle r = layout.take(99.2, 40, c.place).value();
    EXPECT_EQ(r.left, c.left) << c.place;
    EXPECT_EQ(r.top, c.top) << c.place;
    EXPECT_EQ(r.right - r.left, 100) << c.place;
  }
}

TEST(OverlayLayout, LaterOnesMakeRoom) {
  OverlayLayout layout(640, 360);
  const Rectangle first = layout.take(200, 30, "bottom_left").value(),
                  second = layout.take(200, 30, "bottom_left").value();
  EXPECT_EQ(second.left, first.left);
  EXPECT_LT(second.bottom, first.top) << "above it, which is nearer than beside it";
  const Rectangle tall = layout.take(30, 200, "right").value(), next = layout.take(30, 200, "right").value();
  EXPECT_EQ(next.top, tall.top);
  EXPECT_LT(next.right, tall.left) << "beside it";
  EXPECT_FALSE(layout.take(600, 300, "top"));
  EXPECT_FALSE(layout.take(700, 10, "top"));
  EXPECT_EQ(layout.taken().size(), 4U);
}

/// All of them in every place, over what a whole picture's caption takes of a panel, at usual sizes of
/// pictures and panels.
TEST(OverlayLayout, BarsCaptionAndDiagramLieApart) {
  const std::vector<ColorBar> bars = {
      {"von Mises stress", "Pa", &render::find_colormap("viridis"), 0.0, 84321.0},
      {"displacement", "m", &render::find_colormap("plasma"), 0.0, 0.0123}};
  const EnergyAxes axes{.time = {0.0, 5.0}, .energy = {-1234.0, 5678.0}};
  int pictures = 0, whole = 0;
  for (const auto& [width, height] :
       {std::array{854, 480}, std::array{1280, 720}, std::array{1920, 1080}, std::array{425, 480},
        std::array{638, 720}, std::array{958, 1080}, std::array{425, 238}, std::array{638, 358},
        std::array{958, 538}, std::array{480, 854}, std::array{1080, 1920}, std::array{720, 720}}) {
    for (const std::string& caption : caption_places()) {
      for (const std::string& plot : caption_places()) {
        OverlayLayout layout(width, height);
        layout.occupy({0.4 * width, height - 40.0, 0.6 * width, height - 12.0});
        const auto placed =
            place_color_bars(layout, {bars.begin(), bars.begin() + 1 + (width > height ? 1 : 0)});
        ASSERT_FALSE(placed.empty()) << width << " x " << height;
        const auto title = place_caption(layout, "bar, frame 12, t = 0.40 s", caption);
        const auto diagram = place_energy_plot(layout, axes, plot);
        ASSERT_TRUE(apart_and_inside(layout)) << width << " x " << height << " " << caption << " " << plot;
        ASSERT_TRUE(title) << width << " x " << height << " " << caption;
        ++pictures;
        if (diagram) ++whole;
      }
    }
  }
  EXPECT_GE(whole, pictures * 9 / 10) << "of " << pictures;
}

}  // namespace layout_test
}  // namespace lagomorph::apps
