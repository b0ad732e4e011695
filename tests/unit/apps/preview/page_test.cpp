#include "tests/unit/apps/preview/preview_fixture.h"

/// RUN/preview/index.html, without a browser: tests/full/preview.sh has one.
namespace lagomorph::tests {
namespace page_test {

using PreviewPage = PreviewFixture;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST_F(PreviewPage, TellsARunInItself) {
  expect(0, run("run"));
  EXPECT_EQ(preview("run", {"--quiet"}).status, 0);
  const std::string page = made("run", "index.html");
  EXPECT_TRUE(contains(page, "<title>bar: 4 frames, 0.13 s at 30 fps, all steps converged</title>"));
  EXPECT_TRUE(
      contains(page, "<h1>bar</h1><p>4 frames, 0.13 s at 30 fps, <span class=\"good\">all steps converged"));
  EXPECT_EQ(count(page, "{\"n\":"), 4U);            // the player's frames
  EXPECT_EQ(count(page, "<a href=\"#frame="), 4U);  // the sheet's
  EXPECT_EQ(count(page, "<figure class=\"chart\""), 3U);
  EXPECT_TRUE(contains(page, "young = 20000.0"));  // the scene
  EXPECT_TRUE(contains(page, "<dt>cpu</dt>"));
  for (const char* outside : {"http:", "https:", "src=\"/", "url(", "@import", "<link"})
    EXPECT_FALSE(contains(page, outside)) << outside;
}

TEST_F(PreviewPage, DoesWithoutPicturesAndWithoutEnergies) {
  expect(0, simulate("run"));
  EXPECT_EQ(preview("run", {"--quiet"}).status, 0);
  std::string page = made("run", "index.html");
  EXPECT_FALSE(contains(page, "id=\"still\""));
  EXPECT_EQ(count(page, "<figure class=\"chart\""), 3U);
  EXPECT_TRUE(contains(page, "<li>there are no pictures; this draws them: lagomorph render "));
  add_pictures("shots");
  EXPECT_EQ(preview("shots", {"--quiet"}).status, 0);
  page = made("shots", "index.html");
  EXPECT_TRUE(contains(page, "id=\"still\""));
  EXPECT_FALSE(contains(page, "<figure"));
  EXPECT_FALSE(contains(page, "\"t\":"));  // a time would be a guess
}

TEST_F(PreviewPage, EscapesNamesAndScenes) {
  expect(0, run("run", {"--frames", "0..1"}));
  dir_.write("run/scene.toml", "name = \"</pre><b>x</b>\"\n");
  EXPECT_EQ(preview("run").status, 0);
  EXPECT_FALSE(contains(made("run", "index.html"), "<b>x"));
  EXPECT_TRUE(contains(made("run", "index.html"), "&lt;/pre&gt;&lt;b&gt;x"));
  add_pictures("<i>&\"'", 1, 2);
  EXPECT_EQ(preview("<i>&\"'").status, 0);
  EXPECT_TRUE(contains(made("<i>&\"'", "index.html"), "<h1>&lt;i&gt;&amp;&quot;&#39;</h1>"));
}

TEST_F(PreviewPage, StaysUnderItsLimitForPicturesThatDoNotCompress) {
  std::uint32_t state = 1;
  for (int frame = 0; frame < 40; ++frame) {
    render::Picture noise{320, 320, std::vector<std::uint8_t>(3 * 320 * 320)};
    for (std::uint8_t& v : noise.rgb)
      v = static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> 24U);
    dir_.write("noise/" + std::to_string(frame) + ".png", render::encode_png(noise, 0));
  }
  EXPECT_EQ(preview("noise", {}, {.environment = {{"PATH", at("nowhere").string()}}}).status, 0);
  const std::string page = made("noise", "index.html");
  EXPECT_LT(page.size(), 10'000'000U);
  EXPECT_TRUE(contains(page, "{\"n\":0,"));
  EXPECT_GE(count(page, "{\"n\":"), 7U);
}

TEST_F(PreviewPage, MarksFramesThatCannotBeRead) {
  add_pictures("shots", 1, 4);
  dir_.write("shots/shot2.png", "no picture");
  EXPECT_EQ(preview("shots").status, 0);
  EXPECT_EQ(count(made("shots", "index.html"), "<div class=\"none\">unreadable</div>"), 1U);
}

}  // namespace page_test
}  // namespace lagomorph::tests
