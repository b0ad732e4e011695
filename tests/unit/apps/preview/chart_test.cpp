#include "apps/page/chart.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace chart_test {

using Values = std::vector<double>;

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

bool contains(const std::string& text, const std::string& part) { return count(text, part) > 0; }

TEST(Chart, DrawsLines) {
  const std::string html =
      chart_html({.title = "Energy <J>",
                  .unit = "J",
                  .frames = {0, 1, 2},
                  .series = {{"kinetic", "s1", {0, 1, 0}}, {"elastic", "s2", {0, -1, 1}}}});
  EXPECT_TRUE(contains(html, "points=\"0.0,150.0 500.0,0.0 1000.0,150.0 \"")) << html;
  EXPECT_TRUE(contains(html, "points=\"0.0,150.0 500.0,300.0 1000.0,0.0 \"")) << html;
  EXPECT_TRUE(contains(html, "Energy &lt;J&gt;")) << html;
  EXPECT_TRUE(contains(html, "data-values=\"0 -1 1\"")) << html;
}

TEST(Chart, StacksBars) {
  const std::string html = chart_html({.title = "Time",
                                       .unit = "ms",
                                       .frames = {0, 1},
                                       .series = {{"a", "s1", {1, 2}}, {"b", "s2", {0, 2}}},
                                       .bars = true});
  // 0 .. 4 on 300 high: the first bar of a is 75 high, b stands on a's second.
  EXPECT_TRUE(
      contains(html, "class=\"s1\" d=\"M40.0 300.0H460.0V225.0H40.0ZM540.0 300.0H960.0V150.0H540.0Z\""))
      << html;
  EXPECT_TRUE(contains(html, "class=\"s2\" d=\"M540.0 150.0H960.0V0.0H540.0Z\"")) << html;
}

TEST(Chart, StandsOneFrameZerosAndManyFrames) {
  EXPECT_FALSE(
      contains(chart_html({.title = "t", .unit = "", .frames = {7}, .series = {{"a", "s1", {0}}}}), "nan"));
  Chart many{.title = "t", .unit = "", .frames = {}, .series = {{"a", "s1", {}}}};
  for (int i = 0; i < 5000; ++i) many.frames.push_back(i), many.series[0].values.push_back(i % 7);
  const std::string html = chart_html(many);
  const std::string points =
      html.substr(html.find("points="), html.find("\"/>", html.find("points=")) - html.find("points="));
  EXPECT_LE(std::count(points.begin(), points.end(), ','), 600);
}

}  // namespace chart_test
}  // namespace lagomorph::apps
