#include "apps/plot/figure.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace figure_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<Stroke> strokes_of(const Drawing& drawing, double least_width) {
  std::vector<Stroke> all;
  for (const auto& shape : drawing.shapes) {
    const auto* stroke = std::get_if<Stroke>(&shape);
    if (stroke != nullptr && stroke->width >= least_width) all.push_back(*stroke);
  }
  return all;
}

const Words& words_of(const Drawing& drawing, const std::string& text) {
  for (const auto& shape : drawing.shapes) {
    const auto* words = std::get_if<Words>(&shape);
    if (words != nullptr && words->text == text) return *words;
  }
  throw std::runtime_error("not written: " + text);
}

double length_of(const std::vector<Segment>& segments) {
  double sum = 0;
  for (const Segment& s : segments) sum += std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
  return sum;
}

/// A parabola and a line over 0..4.
Figure plain() {
  return {.title = "Sizes",
          .x = {.label = "time", .unit = "s"},
          .y = {.label = "energy", .unit = "J"},
          .curves = {{"parabola", {0, 1, 2, 3, 4}, {0, 1, 4, 9, 16}},
                     {"line", {0, 1, 2, 3, 4}, {0, 4, 8, 12, 16}}}};
}

TEST(Figure, NamesAxesWithUnitsAndCurvesAtTheirEnds) {
  const Drawing drawing = draw_figure(plain());
  for (const char* text : {"Sizes", "time [s]", "energy [J]", "20", "15", "0", "4"}) words_of(drawing, text);
  const Words parabola = words_of(drawing, "parabola"), line = words_of(drawing, "line");
  EXPECT_NE(parabola.color, line.color);
  EXPECT_GE(std::abs(parabola.at.y - line.at.y), 1.5 * parabola.height);  // they end at one point
  EXPECT_EQ(strokes_of(drawing, 2).at(0).color, parabola.color);
}

TEST(Figure, IsToScale) {
  const std::vector<Stroke> curves = strokes_of(draw_figure(plain()), 2);
  ASSERT_EQ(curves.size(), 2U);
  const auto& s = curves[0].segments;
  ASSERT_EQ(s.size(), 4U);
  const double step = s[0].b.x - s[0].a.x, unit = (s[0].a.y - s[0].b.y) / 1.0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(s[i].b.x - s[i].a.x, step, 1e-9);
    EXPECT_NEAR(s[i].a.y - s[i].b.y, unit * (2.0 * static_cast<double>(i) + 1), 1e-9);
  }
  const double ratio = (words_of(draw_figure(plain()), "0").at.y - words_of(draw_figure(plain()), "20").at.y);
  EXPECT_NEAR(ratio, 20 * unit, 1e-9);
}

TEST(Figure, BreaksLinesAtGapsAndCutsThemAtLimits) {
  Figure figure = plain();
  figure.curves = {{"a", {0, 1, 2, 3, 4}, {1, nan, 1, 3, 5}}};
  figure.y.low = 0, figure.y.high = 2;
  const auto s = strokes_of(draw_figure(figure), 2).at(0).segments;
  ASSERT_EQ(s.size(), 2U);  // a dot at 0, from 2 to half way to 3, nothing of the rest
  EXPECT_EQ(s[0].a.x, s[0].b.x);
  EXPECT_NEAR((s[1].b.x - s[0].a.x) / (s[1].a.x - s[0].a.x), 2.5 / 2, 1e-9);
}

TEST(Figure, OfDecadesLeavesOutWhatIsNotPositive) {
  Figure figure = plain();
  figure.y.log = true;
  figure.curves = {{"a", {0, 1, 2, 3}, {0, 1e-3, 1e-5, 1e-7}}};
  const auto s = strokes_of(draw_figure(figure), 2).at(0).segments;
  ASSERT_EQ(s.size(), 2U);
  EXPECT_NEAR(s[0].b.y - s[0].a.y, s[1].b.y - s[1].a.y, 1e-9);
  words_of(draw_figure(figure), "1e-05");
}

TEST(Figure, HasWholeTicksForNumbers) {
  Figure figure = plain();
  figure.y.whole = true;
  figure.curves = {{"a", {0, 40}, {0, 1}}};
  const std::string svg = svg_text(draw_figure(figure));
  EXPECT_FALSE(contains(svg, ">0.5<")) << svg;
  EXPECT_TRUE(contains(svg, ">1</text>"));
}

TEST(Figure, DashesWhatRepeatsAColour) {
  Figure figure = plain();
  figure.curves.assign(8, figure.curves[0]);
  const std::vector<Stroke> curves = strokes_of(draw_figure(figure), 2);
  ASSERT_EQ(curves.size(), 8U);
  EXPECT_EQ(curves[0].color, curves[7].color);
  EXPECT_NEAR(length_of(curves[7].segments) / length_of(curves[0].segments), 9.0 / 16, 0.02);
}

TEST(Figure, StandsNothingOneValueAndNotANumber) {
  for (const std::vector<double>& y : {std::vector<double>{}, {3}, {nan}, {0}}) {
    for (const bool log : {false, true}) {
      Figure figure{.title = "t", .x = {.label = "x"}, .y = {.label = "y", .log = log}, .curves = {}};
      figure.curves.push_back({"a", std::vector<double>(y.size(), 7.0), y});
      const std::string svg = svg_text(draw_figure(figure));
      EXPECT_FALSE(contains(svg, "nan") || contains(svg, "inf")) << svg;
    }
  }
}

TEST(Figure, IsTextAndPixelsOfTheSamePlaces) {
  const Drawing drawing = draw_figure(plain(), 600, 400);
  const std::string svg = svg_text(drawing);
  EXPECT_TRUE(contains(svg, "viewBox=\"0 0 600 400\""));
  EXPECT_TRUE(contains(svg, ">energy [J]</text>"));
  const render::Picture picture = picture_of(drawing);
  EXPECT_EQ(picture.rgb.size(), 600U * 400 * 3);
  const Stroke line = strokes_of(drawing, 1.25).at(0);
  const Segment s = line.segments.at(2);
  const int x = static_cast<int>(0.5 * (s.a.x + s.b.x)), y = static_cast<int>(0.5 * (s.a.y + s.b.y));
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * 600 + static_cast<std::size_t>(x));
  EXPECT_LT(picture.rgb[at], 120) << "no blue line there";
  EXPECT_GT(picture.rgb[at + 2], 150);
}

TEST(Figure, EscapesNames) {
  Figure figure = plain();
  figure.title = "<&>";
  EXPECT_TRUE(contains(svg_text(draw_figure(figure)), "&lt;&amp;&gt;"));
}

TEST(Strokes, AreNotDarkerWhereTheyCross) {
  render::Picture picture{20, 20, std::vector<std::uint8_t>(1200, 255)};
  const std::vector<Segment> cross = {{{2, 10}, {18, 10}}, {{10, 2}, {10, 18}}, {{2, 10}, {18, 10}}};
  draw_strokes(picture, cross, 1, {0, 0, 0});
  const auto red = [&](std::size_t x, std::size_t y) { return picture.rgb[3 * (20 * y + x)]; };
  EXPECT_EQ(red(5, 9), red(5, 10));  // a line between two rows of pixels
  EXPECT_EQ(red(5, 9), 128);         // half of each covered
  EXPECT_EQ(red(10, 10), 128);
  EXPECT_EQ(red(1, 1), 255);
}

}  // namespace figure_test
}  // namespace lagomorph::apps
