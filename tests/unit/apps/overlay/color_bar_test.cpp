#include "apps/overlay/color_bar.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "apps/overlay/overlay.h"

namespace lagomorph::apps {
namespace color_bar_test {

void draw_bars(render::Picture& picture, const std::vector<ColorBar>& bars) {
  OverlayLayout layout(picture.width, picture.height);
  draw_color_bars(picture, bars, place_color_bars(layout, bars));
}

using Rgb = std::array<std::uint8_t, 3>;

render::Picture plain(int width, int height, std::uint8_t value) {
  return {width, height,
          std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                    value)};
}

Rgb pixel(const render::Picture& picture, int x, int y) {
  const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                       static_cast<std::size_t>(x));
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

ColorBar stress(double low = 0.0, double high = 84321.0) {
  return {"von Mises stress", "Pa", &render::find_colormap("viridis"), low, high};
}

std::string text(const BarLabels& labels) {
  std::string all = labels.title + ":";
  for (const BarLabel& label : labels.ticks) all += " " + label.text;
  return all;
}

TEST(ColorBar, HasRoundNumbersInAShortUnit) {
  EXPECT_EQ(text(labels_of(stress())), "von Mises stress (kPa): 0 20 40 60 80");
  EXPECT_EQ(text(labels_of(stress(2.1e9, 2.35e9))), "von Mises stress (GPa): 2.10 2.15 2.20 2.25 2.30 2.35");
  EXPECT_EQ(text(labels_of(stress(0, 1e12))), "von Mises stress (TPa): 0 0.2 0.4 0.6 0.8 1.0");
  EXPECT_EQ(text(labels_of(stress(0, 9.9e14))), "von Mises stress (TPa): 0 200 400 600 800");
  EXPECT_EQ(text(labels_of({"displacement", "m", nullptr, 0, 0.0123})), "displacement (mm): 0 2 4 6 8 10 12");
  EXPECT_EQ(text(labels_of({"displacement", "m", nullptr, 0, 1.5})),
            "displacement (m): 0 0.2 0.4 0.6 0.8 1.0 1.2 1.4");
  EXPECT_EQ(text(labels_of({"volume ratio J", "", nullptr, 0.93, 1.07})),
            "volume ratio J: 0.94 0.96 0.98 1.00 1.02 1.04 1.06");
  EXPECT_EQ(text(labels_of({"x", "", nullptr, -2e7, 2e7})),
            "x: -2e+07 -1.5e+07 -1e+07 -5e+06 0 5e+06 1e+07 1.5e+07 2e+07");
  EXPECT_EQ(text(labels_of({"elastic energy density", "J/m^3", nullptr, -3, 6})),
            "elastic energy density (J/m^3): -2 0 2 4 6");
  EXPECT_EQ(text(labels_of({"density", "kg/m^3", nullptr, 1000, 2000})),
            "density (kg/m^3): 1000 1200 1400 1600 1800 2000");
}

TEST(ColorBar, TicksStandAtTheirValues) {
  const ColorBar bar = stress(-3.7e4, 8.3e4);
  const BarLabels labels = labels_of(bar);
  ASSERT_GE(labels.ticks.size(), 4U);
  for (const BarLabel& label : labels.ticks) {
    EXPECT_NEAR(label.value, 1e3 * std::stod(label.text), 1e-6) << label.text;
    EXPECT_TRUE(label.value >= bar.low && label.value <= bar.high) << label.text;
  }
}

/// The rows of the bar, from the first to the last that is of the map's colours.
TEST(ColorBar, ShowsTheMapFromBelowUpwards) {
  for (const std::uint8_t ground : {std::uint8_t{0}, std::uint8_t{128}, std::uint8_t{255}}) {
    render::Picture picture = plain(640, 360, ground);
    draw_bars(picture, {stress()});
    const auto near = [&](int x, int y, float value) {
      const auto wanted = render::srgb_of(render::find_colormap("viridis"), value);
      const Rgb is = pixel(picture, x, y);
      for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(255.0F * wanted[c] - is[c]) > 2.0F) return false;
      return true;
    };
    int column = -1, top = -1, bottom = -1;
    for (int x = 320; x < 640 && column < 0; ++x) {
      for (int y = 0; y < 360; ++y) {
        if (near(x, y, 1.0F) && top < 0) top = y, column = x;
        if (x == column && near(x, y, 0.0F)) bottom = y;
      }
    }
    ASSERT_GE(column, 0);
    ASSERT_GT(bottom - top, 120) << "two fifths of the picture";
    for (int k = 0; k <= 8; ++k) {
      const float value = static_cast<float>(k) / 8.0F;
      const int y = bottom - static_cast<int>(std::lround(value * static_cast<float>(bottom - top)));
      const float row = 1.0F / static_cast<float>(bottom - top);
      EXPECT_TRUE(near(column, y, value - row) || near(column, y, value) || near(column, y, value + row))
          << k;
    }
  }
}

double luminance(const Rgb& c) {
  return 0.2126 * render::linear_from_srgb(c[0] / 255.0F) + 0.7152 * render::linear_from_srgb(c[1] / 255.0F) +
         0.0722 * render::linear_from_srgb(c[2] / 255.0F);
}

/// WCAG 2's least for small text is 4.5.
TEST(ColorBar, ReadsOnLightAndDark) {
  for (const std::uint8_t ground : {std::uint8_t{0}, std::uint8_t{120}, std::uint8_t{255}}) {
    render::Picture picture = plain(32, 32, ground);
    draw_plate(picture, {0, 0, 32, 32});
    EXPECT_GE((luminance(plate_ink) + 0.05) / (luminance(pixel(picture, 9, 9)) + 0.05), 4.5) << int{ground};
  }
}

int changed_columns(int width, int height) {
  render::Picture picture = plain(width, height, 255);
  draw_bars(picture, {stress()});
  int count = 0;
  for (int x = 0; x < width; ++x) {
    bool changed = false;
    for (int y = 0; y < height; ++y) changed = changed || pixel(picture, x, y) != Rgb{255, 255, 255};
    count += changed ? 1 : 0;
  }
  return count;
}

TEST(ColorBar, GrowsWithThePicture) {
  const int small = changed_columns(1280, 720);
  EXPECT_GT(small, 60);
  EXPECT_NEAR(changed_columns(2560, 1440), 2 * small, 4);
  EXPECT_EQ(changed_columns(24, 16), 0) << "no room";
}

/// Of a panel half as wide it takes no larger part.
TEST(ColorBar, ShrinksWithItsPanel) {
  for (const auto& [width, height] : {std::array{1278, 720}, std::array{638, 720}, std::array{638, 358},
                                      std::array{424, 238}, std::array{320, 480}, std::array{1080, 1920}}) {
    const double strip = color_bar_strip(width, height, {stress()});
    EXPECT_GT(strip, 0.05) << width << " x " << height;
    EXPECT_LT(strip, 0.27) << width << " x " << height;
  }
  EXPECT_EQ(color_bar_strip(640, 360, {}), 0.0);
  EXPECT_EQ(color_bar_strip(24, 16, {stress()}), 0.0) << "no room";
}

ColorBar given(double low, double high, bool below, bool above) {
  ColorBar bar = stress(low, high);
  bar.given = true, bar.below = below, bar.above = above;
  return bar;
}

TEST(ColorBar, LabelsTellValuesBeyondItsEnds) {
  EXPECT_EQ(text(labels_of(given(0, 8e4, false, false))),
            "von Mises stress (kPa): 0 10 20 30 40 50 60 70 80");
  EXPECT_EQ(text(labels_of(given(0, 8e4, false, true))),
            "von Mises stress (kPa): 0 10 20 30 40 50 60 70 ≥80");
  EXPECT_EQ(text(labels_of(given(2e4, 8e4, true, false))), "von Mises stress (kPa): ≤20 30 40 50 60 70 80");
  EXPECT_EQ(text(labels_of(given(1.87e4, 8.4321e4, true, true))),
            "von Mises stress (kPa): ≤18.7 30 40 50 60 70 ≥84.32")
      << "ends that are not round have labels then, and those close to them have none";
}

/// Of the map's first or last colour, in the middle of the bar.
int rows_of_end(const render::Picture& picture, float value) {
  const auto wanted = render::srgb_of(render::find_colormap("viridis"), value);
  int most = 0;
  for (int x = picture.width / 2; x < picture.width; ++x) {
    int rows = 0;
    for (int y = 0; y < picture.height; ++y) {
      const Rgb is = pixel(picture, x, y);
      bool same = true;
      for (std::size_t c = 0; c < 3; ++c) same = same && std::abs(255.0F * wanted[c] - is[c]) < 1.5F;
      rows += same ? 1 : 0;
    }
    most = std::max(most, rows);
  }
  return most;
}

TEST(ColorBar, EndsArePointedWhereValuesLieBeyond) {
  const auto drawn = [](bool below, bool above) {
    render::Picture picture = plain(1280, 720, 255);
    draw_bars(picture, {given(0, 8e4, below, above)});
    return picture;
  };
  const render::Picture none = drawn(false, false), low = drawn(true, false), high = drawn(false, true);
  const int tip = 10;  // rows, of 17
  EXPECT_GT(rows_of_end(low, 0.0F), rows_of_end(none, 0.0F) + tip);
  EXPECT_EQ(rows_of_end(low, 1.0F), rows_of_end(none, 1.0F));
  EXPECT_GT(rows_of_end(high, 1.0F), rows_of_end(none, 1.0F) + tip);
  EXPECT_EQ(rows_of_end(high, 0.0F), rows_of_end(none, 0.0F));
}

/// A fitted camera depends on it, and plates do not jump from frame to frame.
TEST(ColorBar, TakesTheSameRoomWhetherValuesLieBeyondOrNot) {
  for (const auto& [width, height] : {std::array{1280, 720}, std::array{424, 238}, std::array{159, 89}}) {
    OverlayLayout a(width, height), b(width, height);
    const Rectangle inside = place_color_bars(a, {given(1.87e4, 8.4321e4, false, false)}).at(0),
                    beyond = place_color_bars(b, {given(1.87e4, 8.4321e4, true, true)}).at(0);
    EXPECT_EQ(inside.left, beyond.left) << width;
    EXPECT_EQ(inside.top, beyond.top) << width;
    EXPECT_EQ(inside.bottom, beyond.bottom) << width;
  }
}

TEST(ColorBar, LabelsInSmallPicturesDoNotTouch) {
  const ColorBar bars[] = {stress(),
                           stress(0, 80),
                           stress(1.1e4, 1.9e4),
                           {"volume ratio J", "", &render::find_colormap("coolwarm"), 0.93, 1.07},
                           given(1.87e4, 8.4321e4, true, true),
                           given(0, 8e4, true, true)};
  for (const auto& [width, height] : {std::array{1280, 720}, std::array{640, 360}, std::array{318, 178},
                                      std::array{159, 89}, std::array{120, 80}}) {
    const double bar_height = 42.0 * overlay_unit(width, height),
                 letters = overlay_text_height(width, height);
    for (const ColorBar& bar : bars) {
      const BarLabels labels = labels_in(width, height, bar);
      EXPECT_GE(labels.ticks.size(), 2U) << width << " " << labels.title;
      for (std::size_t i = 1; i < labels.ticks.size(); ++i) {
        const double apart = (labels.ticks[i].value - labels.ticks[i - 1].value) / (bar.high - bar.low);
        EXPECT_GE(apart * bar_height, 1.3 * letters - 1e-9) << width << " " << text(labels);
      }
    }
  }
  EXPECT_EQ(text(labels_in(1280, 720, stress())), text(labels_of(stress())));
}

TEST(ColorBar, TakesAThirdOfASmallPanel) {
  const ColorBar bars[] = {stress(),
                           {"soft: displacement", "m", &render::find_colormap("viridis"), 0.0, 0.0123},
                           {"elastic energy density", "J/m^3", &render::find_colormap("magma"), 0.0, 2.5},
                           given(1.87e4, 8.4321e4, true, true)};
  for (const auto& [width, height] : {std::array{159, 89}, std::array{318, 178}, std::array{212, 238}}) {
    for (const ColorBar& bar : bars) {
      OverlayLayout layout(width, height);
      const std::vector<Rectangle> plates = place_color_bars(layout, {bar});
      ASSERT_EQ(plates.size(), 1U) << bar.title << " " << width;
      EXPECT_LE(plates[0].right - plates[0].left, 0.38 * width) << bar.title << " " << width;
    }
  }
}

TEST(ColorBar, SeveralStandBesideEachOther) {
  render::Picture one = plain(1280, 720, 255), two = one, none = one;
  const ColorBar other{"volume ratio J", "", &render::find_colormap("coolwarm"), 0.9, 1.1};
  draw_bars(one, {stress()});
  draw_bars(two, {stress(), other});
  draw_bars(none, {});
  EXPECT_EQ(none.rgb, plain(1280, 720, 255).rgb);
  for (int y = 0; y < 720; ++y) {
    for (int x = 0; x < 1280; ++x) {
      if (pixel(one, x, y) != Rgb{255, 255, 255}) {
        ASSERT_EQ(pixel(one, x, y), pixel(two, x, y));
      }
    }
  }
  EXPECT_NE(one.rgb, two.rgb);
}

TEST(Overlay, RectanglesCoverPixelsInPart) {
  render::Picture picture = plain(6, 4, 200);
  fill_rectangle(picture, {1.5, -3.0, 4.0, 2.25}, {0, 100, 200});
  EXPECT_EQ(pixel(picture, 0, 0), (Rgb{200, 200, 200}));
  EXPECT_EQ(pixel(picture, 1, 0), (Rgb{100, 150, 200}));
  EXPECT_EQ(pixel(picture, 3, 1), (Rgb{0, 100, 200}));
  EXPECT_EQ(pixel(picture, 3, 2), (Rgb{150, 175, 200}));
  EXPECT_EQ(pixel(picture, 4, 1), (Rgb{200, 200, 200}));
  fill_rectangle(picture, {-10, -10, 100, 100}, {0, 0, 0}, 0.5);
  EXPECT_EQ(pixel(picture, 5, 3), (Rgb{100, 100, 100}));
}

}  // namespace color_bar_test
}  // namespace lagomorph::apps
