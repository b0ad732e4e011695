#include "apps/overlay/caption.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace caption_test {

const CaptionValues some = {.name = "bunny",
                            .frame = 7,
                            .frames = 150,
                            .time = 0.23333,
                            .kinetic = 1.5,
                            .elastic = 2.25,
                            .gravitational = -3.0,
                            .total = 0.75,
                            .iterations = 4,
                            .min_J = 0.6};

TEST(Caption, PutsValuesInTheirPlaces) {
  EXPECT_EQ(caption_text("{name} {frame:04}/{frames}, t = {time:.2f} s", some), "bunny 0007/150, t = 0.23 s");
  EXPECT_EQ(caption_text("{kinetic} {elastic:.1f} {gravitational} {total} {iterations} {min_J} {{}}", some),
            "1.5 2.2 -3 0.75 4 0.6 {}");
  EXPECT_EQ(caption_text("", some), "");
}

TEST(Caption, TellsWhatIsWrong) {
  for (const char* form : {"{fram}", "{frame:q}", "{", "}", "{99}", "{time:04d}"}) {
    try {
      caption_text(form, some);
      FAIL() << form;
    } catch (const Error& e) {
      EXPECT_EQ(e.status, ExitStatus::wrong_input);
      EXPECT_NE(std::string(e.what()).find("values are {name}, {frame}"), std::string::npos) << e.what();
    }
  }
}

/// Columns and rows of what differs from the plain picture.
struct Drawn {
  int left, right, top, bottom;
};
Drawn drawn(const std::string& text, const std::string& place, int width = 320, int height = 180) {
  const render::Picture plain{width, height,
                              std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), 128)};
  render::Picture picture = plain;
  OverlayLayout layout(width, height);
  if (const auto caption = place_caption(layout, text, place)) draw_caption(picture, *caption);
  Drawn d{width, -1, height, -1};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * width + x));
      if (picture.rgb[at] == plain.rgb[at]) continue;
      d = {std::min(d.left, x), std::max(d.right, x), std::min(d.top, y), std::max(d.bottom, y)};
    }
  }
  return d;
}

TEST(Caption, StandsWhereItIsToStand) {
  for (const std::string& place : caption_places()) {
    const Drawn d = drawn("frame 7", place);
    ASSERT_GT(d.right, d.left) << place;
    EXPECT_EQ(d.bottom < 90, place.starts_with("top")) << place;
    EXPECT_EQ(d.right < 160, place.ends_with("left")) << place;
    EXPECT_EQ(d.left > 160, place.ends_with("right")) << place;
    EXPECT_GT(d.top, 2);
    EXPECT_LT(d.bottom, 178);
  }
  const Drawn one = drawn("frame 7", "top"), two = drawn("frame 7\nt = 1 s", "top");
  EXPECT_GT(two.bottom - two.top, one.bottom - one.top + 6);
}

TEST(Caption, KeepsItsPlateWhileDigitsChange) {
  const Drawn one = drawn("frame 111", "bottom_left"), two = drawn("frame 888", "bottom_left");
  EXPECT_EQ(one.right, two.right);
}

/// As much of the plate is on the left of the letters as on their right, of titles and of captions with
/// digits.
TEST(Caption, StandsInTheMiddleOfItsPlate) {
  const int width = 640, height = 360;
  for (const std::string text : {"0.5 MPa", "a stiff bunny", "t = 11.11 s", "frame 888"}) {
    OverlayLayout layout(width, height);
    const Caption caption = place_caption(layout, text, "top").value();
    const Rectangle& plate = caption.plate;
    render::Picture with{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, 128)},
        bare = with;
    draw_caption(with, caption);
    draw_plate(bare, plate);
    int first = width, last = -1;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto at = static_cast<std::size_t>(3 * (y * width + x));
        if (with.rgb[at] != bare.rgb[at]) first = std::min(first, x), last = std::max(last, x);
      }
    }
    const double left = first - plate.left, right = plate.right - 1 - last;
    const bool has_ones = text.find('1') != std::string::npos;  // narrower than the widest digit
    EXPECT_LE(std::abs(left - right), has_ones ? 16.0 : 2.0) << text;
    EXPECT_GE(std::min(left, right), 5.0) << text;
  }
}

TEST(Caption, IsNotDrawnWhereThereIsNoRoom) {
  EXPECT_EQ(drawn("", "top").right, -1);
  EXPECT_EQ(drawn("frame 7", "top", 20, 8).right, -1);
  OverlayLayout full(320, 180);
  full.occupy({0, 0, 320, 180});
  EXPECT_FALSE(place_caption(full, "frame 7", "top"));
}

std::string joined(const std::vector<std::string>& lines, const std::string& between) {
  std::string all;
  for (const std::string& line : lines) all += (all.empty() ? "" : between) + line;
  return all;
}

std::string words(int count) {
  std::string text = "word";
  for (int i = 1; i < count; ++i) text += " word";
  return text;
}

bool is_within(const Rectangle& r, int width, int height) {
  return r.left >= 0 && r.top >= 0 && r.right <= width && r.bottom <= height;
}

TEST(Caption, IsWrappedAtSpacesToThePicturesWidth) {
  const std::string text = words(48);
  for (const std::string& place : caption_places()) {
    OverlayLayout layout(640, 360);
    const Caption caption = place_caption(layout, text, place).value();
    EXPECT_TRUE(is_within(caption.plate, 640, 360)) << place;
    EXPECT_GT(caption.plate.right - caption.plate.left, 540) << place;
    EXPECT_GE(caption.lines.size(), 2U) << place;
    EXPECT_LE(caption.lines.size(), 3U) << place;
    EXPECT_EQ(joined(caption.lines, " "), text) << place;
  }
  OverlayLayout layout(640, 360);
  const Caption caption = place_caption(layout, "title\n\n" + text, "top").value();
  EXPECT_EQ(caption.lines[0], "title");
  EXPECT_EQ(caption.lines[1], "");
  const Drawn d = drawn(text, "bottom", 640, 360);
  EXPECT_LT(d.left, 60);
  EXPECT_GT(d.right, 580);
}

/// Titles of panels: as tall as they are wanted, smaller where they have no room, wrapped at the least size.
TEST(Caption, IsAsTallAsItsLayoutWantsWhereThereIsRoom) {
  const auto placed = [](const std::string& text) {
    OverlayLayout layout(424, 358);
    layout.set_caption_height(9.3);
    const Caption caption = place_caption(layout, text, "top").value();
    EXPECT_TRUE(is_within(caption.plate, 424, 358)) << text;
    return caption;
  };
  const double least = OverlayLayout(424, 358).text_height();
  EXPECT_EQ(placed("2 MPa").height, 9.3);
  const Caption longer = placed(words(14));
  EXPECT_EQ(longer.lines.size(), 1U);
  EXPECT_GT(longer.height, least);
  EXPECT_LT(longer.height, 9.0);
  const Caption wrapped = placed(words(30));
  EXPECT_EQ(wrapped.height, least);
  EXPECT_GT(wrapped.lines.size(), 1U);
  EXPECT_EQ(joined(wrapped.lines, " "), words(30));
}

TEST(Caption, IsNarrowerBesideWhatIsThere) {
  OverlayLayout layout(640, 360);
  layout.occupy({0, 0, 200, 360});
  const Caption caption = place_caption(layout, words(24), "bottom_left").value();
  EXPECT_GT(caption.plate.left, 200);
  EXPECT_EQ(joined(caption.lines, " "), words(24));
}

TEST(Caption, IsCutWhereThereIsNoRoomInHeight) {
  const std::string text = words(400);
  OverlayLayout layout(320, 180);
  const Caption caption = place_caption(layout, text, "bottom_left").value();
  EXPECT_TRUE(is_within(caption.plate, 320, 180));
  EXPECT_GT(caption.plate.bottom - caption.plate.top, 120);
  std::string shown = joined(caption.lines, " ");
  ASSERT_TRUE(shown.ends_with("...")) << shown;
  shown.resize(shown.size() - 3);
  EXPECT_TRUE(text.starts_with(shown)) << shown;
  EXPECT_NE(shown.back(), ' ');
}

TEST(Caption, BreaksAWordThatIsWiderThanThePicture) {
  std::string word;
  for (int i = 0; i < 60; ++i) word += "\u00e9x";
  OverlayLayout layout(320, 180);
  const Caption caption = place_caption(layout, "a " + word + " b", "top").value();
  EXPECT_TRUE(is_within(caption.plate, 320, 180));
  EXPECT_EQ(caption.lines.front(), "a");
  for (const std::string& line : caption.lines)
    EXPECT_NE(static_cast<unsigned char>(line.front()) & 0xC0U, 0x80U) << line;  // no half character
  EXPECT_NE(joined(caption.lines, "").find("x b"), std::string::npos);
}

TEST(Caption, WrapsAtTheSamePlacesWhileDigitsChange) {
  std::string ones, eights;
  for (int i = 0; i < 30; ++i) ones += "frame 111 ", eights += "frame 888 ";
  OverlayLayout one(640, 360), two(640, 360);
  const Caption a = place_caption(one, ones, "top").value(), b = place_caption(two, eights, "top").value();
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (std::size_t i = 0; i < a.lines.size(); ++i) EXPECT_EQ(a.lines[i].size(), b.lines[i].size());
  EXPECT_EQ(a.plate.right, b.plate.right);
}

}  // namespace caption_test
}  // namespace lagomorph::apps
