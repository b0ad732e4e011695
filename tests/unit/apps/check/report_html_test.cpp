#include "apps/check/report_html.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace report_html_test {

CheckResult failing() {
  CheckResult result;
  result.run = "out/<b>";
  result.golden = "golden/a";
  result.name = "a<script>alert(1)</script>";
  result.causes = {{"scene", "render.width: 64 -> 32 \"<i>\""}};
  for (int number : {3, 4}) {
    FrameResult frame;
    frame.frame = number;
    frame.figures.emplace();
    frame.figures->flip_tile.mean = 0.1 * number;
    frame.failures = {{"flip_tile_max", "0.3 at 1,2", "0.12", "golden.toml:4:17"}};
    frame.hints = {"shifted by 1 pixel to the right"};
    result.frames.push_back(frame);
  }
  return result;
}

TEST(ReportHtml, TellsWhyFirstThenTheVerdictThenTheWorstFrame) {
  const std::string html = report_html(
      failing(), {{.frame = 4, .golden = "", .fresh = "data:x", .heat = "", .width = 4, .height = 4}});
  const std::size_t why = html.find("<b>scene</b>"), verdict = html.find("class=\"verdict\">2 of 2"),
                    rule = html.find(
                        "<b>flip_tile_max</b> 0.3 at 1,2, limit <b>0.12</b> <i>by golden.toml:4:17</i>"),
                    fourth = html.find("id=\"f4\""), third = html.find("id=\"f3\"");
  ASSERT_NE(third, std::string::npos);
  EXPECT_LT(why, verdict);
  EXPECT_LT(verdict, fourth);
  EXPECT_LT(fourth, rule);
  EXPECT_LT(rule, third);
  EXPECT_NE(html.find("shifted by 1 pixel"), std::string::npos);
  for (const char* command : {"lagomorph check &#39;out/&lt;b&gt;&#39; golden/a --frames 4",
                              "lagomorph render &#39;out/&lt;b&gt;&#39; --frames 4 --force",
                              "lagomorph approve &#39;out/&lt;b&gt;&#39; golden/a --frames 4"})
    EXPECT_NE(html.find(command), std::string::npos) << command;
}

TEST(ReportHtml, EscapesWhatItIsGivenAndAsksForNothing) {
  const std::string html = report_html(failing(), {});
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("\"<i>\""), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos);
}

}  // namespace report_html_test
}  // namespace lagomorph::apps
