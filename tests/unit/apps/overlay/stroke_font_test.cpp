#include "apps/overlay/stroke_font.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "apps/overlay/glyphs.h"
#include "apps/preview/small_picture.h"

namespace lagomorph::apps {
namespace stroke_font_test {

std::vector<std::uint8_t> drawn(const std::string& text, double x = 4, double y = 20) {
  render::Picture picture = filled({32, 32}, {0, 0, 0});
  draw_text(picture, x, y, text, {12, {255, 255, 255}});
  return picture.rgb;
}

bool is_empty(const std::vector<std::uint8_t>& rgb) {
  return std::all_of(rgb.begin(), rgb.end(), [](int v) { return v == 0; });
}

TEST(StrokeFont, HasALetterOfItsOwnForEachOfAscii) {
  std::map<std::vector<std::uint8_t>, char> seen;
  for (char c = '!'; c <= '~'; ++c) {
    const auto [there, is_new] = seen.emplace(drawn(std::string(1, c)), c);
    // A capital I and a small l are the same stroke.
    EXPECT_TRUE(is_new || c == 'l') << c << " looks like " << there->second;
  }
  EXPECT_TRUE(is_empty(drawn(" ")));
}

TEST(StrokeFont, HasWellFormedGlyphs) {
  std::vector<std::string_view> all(glyphs.begin(), glyphs.end());
  for (const Sign& sign : signs) all.push_back(sign.glyph);
  for (const std::string_view glyph : all) {
    for (std::size_t i = 0; i < glyph.size(); i += glyph[i] == ' ' ? 1 : 2) {
      if (glyph[i] == ' ') continue;
      ASSERT_LT(i + 1, glyph.size()) << glyph;
      EXPECT_TRUE(glyph[i] >= '0' && glyph[i] <= '9' && glyph[i + 1] >= 'a' && glyph[i + 1] <= 'r') << glyph;
    }
  }
}

TEST(StrokeFont, DrawsABoxForWhatItHasNot) {
  EXPECT_EQ(drawn("я"), drawn("語"));  // one box each, however many bytes
  EXPECT_FALSE(is_empty(drawn("я")));
  EXPECT_EQ(text_width("яя", 12), text_width("語÷", 12));
  EXPECT_EQ(drawn("\xC3"), drawn("я"));  // half a character
}

TEST(StrokeFont, WritesAccentedLettersWithoutTheirAccents) {
  const std::pair<const char*, const char*> alike[] = {
      {"é", "e"},  {"ß", "ss"}, {"ø", "o"}, {"Å", "A"}, {"ÿ", "y"}, {"À", "A"},       {"Æ", "AE"},
      {"œ", "oe"}, {"ł", "l"},  {"Ž", "Z"}, {"ž", "z"}, {"ſ", "s"}, {"e\u0301", "e"}, {"\u00A0", " "}};
  for (const auto& [letter, base] : alike) {
    EXPECT_EQ(drawn(letter), drawn(base)) << letter;
    EXPECT_EQ(text_width(letter, 12), text_width(base, 12)) << letter;
  }
  EXPECT_EQ(text_width("Ångström", 12), text_width("Angstrom", 12));
}

TEST(StrokeFont, HasSignsOfItsOwn) {
  std::map<std::vector<std::uint8_t>, std::string> seen;
  for (char c = '!'; c <= '~'; ++c) seen.emplace(drawn(std::string(1, c)), std::string(1, c));
  seen.emplace(drawn("я"), "a box");
  for (const char* sign : {"≤", "≥", "°", "µ", "·", "×", "±", "σ", "π", "ε", "ν", "ρ", "λ"}) {
    const auto [there, is_new] = seen.emplace(drawn(sign), sign);
    EXPECT_TRUE(is_new) << sign << " looks like " << there->second;
  }
  EXPECT_EQ(drawn("\u00B5"), drawn("\u03BC"));  // micro and mu
  EXPECT_NEAR(text_width("≥80", 12), text_width(">80", 12), 1e-12);
}

TEST(StrokeFont, IsCutAtThePicturesEdge) {
  EXPECT_TRUE(is_empty(drawn("Wide", 40, 20)));
  EXPECT_TRUE(is_empty(drawn("Wide", -90, -20)));
  EXPECT_FALSE(is_empty(drawn("Wide", -6, 3)));
}

TEST(StrokeFont, ShortensToAWidth) {
  EXPECT_EQ(fitting_text("bunny", 12, 1000), "bunny");
  const std::string shorter = fitting_text("a long name of a scene", 12, 80);
  EXPECT_TRUE(shorter.starts_with("a l") && shorter.ends_with("...")) << shorter;
  EXPECT_LE(text_width(shorter, 12), 80);
  EXPECT_GT(text_width(shorter, 12), 60);
  for (double width = 0; width < 60; width += 3) {
    const std::string cut = fitting_text("éééééé", 12, width);
    EXPECT_TRUE(cut.size() % 2 == (cut.ends_with("...") ? 1U : 0U)) << cut;  // no half character
  }
}

}  // namespace stroke_font_test
}  // namespace lagomorph::apps
