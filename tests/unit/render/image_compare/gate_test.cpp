#include "render/image_compare/gate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/pictures.h"

/// The cases that tell a gate's worth: what nobody sees passes, what one looks for fails.
namespace lagomorph::render {
namespace gate_test {

using tests::bytes_of;
using tests::flip_picture;

std::vector<std::string> broken(const Pixels& a, const Pixels& b) {
  std::vector<std::string> rules;
  for (const GateFailure& f : gate_figures(compare_pictures(a, b).figures)) rules.push_back(f.rule);
  return rules;
}

using Rules = std::vector<std::string>;
const Rules none;

template <class Change>
Pixels changed(Pixels pixels, const Change& change) {
  std::vector<std::uint8_t>& bytes = bytes_of(pixels);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(std::clamp(std::lround(change(1.0 * bytes[i], i)), 0L, 255L));
  }
  return pixels;
}

class GateCases : public ::testing::Test {
protected:
  Pixels spheres = flip_picture("spheres_ref.png");
};

TEST_F(GateCases, HarmlessOnesPass) {
  std::uint32_t state = 5;
  const Pixels plus_minus = changed(spheres, [&](double v, std::size_t) {
    state = state * 1664525U + 1013904223U;
    return v + (static_cast<double>((state >> 16U) % 3U) - 1);
  });
  EXPECT_EQ(broken(spheres, plus_minus), none);
  EXPECT_EQ(broken(spheres, changed(spheres, [](double v, std::size_t) { return v + 1; })), none);
  EXPECT_EQ(broken(flip_picture("edge_ref.png"), flip_picture("edge_aa.png")), none);
  EXPECT_EQ(broken(spheres, flip_picture("spheres_mc256.png")), none);
  EXPECT_EQ(broken(spheres, spheres), none);
}

TEST_F(GateCases, FaultsFail) {
  EXPECT_EQ(broken(spheres, flip_picture("spheres_missing.png")), Rules{"flip_tile_max"});
  EXPECT_EQ(broken(spheres, flip_picture("spheres_moved.png")), Rules{"flip_tile_max"});
  const Pixels gamma =
      changed(spheres, [](double v, std::size_t) { return 255 * std::pow(v / 255, 1 / 1.1); });
  EXPECT_NE(broken(spheres, gamma), none);
  const Pixels cast = changed(spheres, [](double v, std::size_t i) { return i % 3 == 2 ? 0.85 * v : v; });
  EXPECT_NE(broken(spheres, cast), none);
  EXPECT_NE(broken(spheres, flip_picture("spheres_mc16.png")), none);
  EXPECT_EQ(broken(flip_picture("black.png"), flip_picture("white.png")),
            (Rules{"flip_tile_max", "flip_mean"}));
}

TEST_F(GateCases, FlipAloneIsBlindToAFineChecker) {
  Pixels checker = flip_picture("checker1.png");
  const Pixels inverted = changed(checker, [](double v, std::size_t) { return 255 - v; });
  const Figures figures = compare_pictures(checker, inverted).figures;
  EXPECT_LT(figures.flip_mean, 0.02);
  EXPECT_FALSE(figures.equal);
  EXPECT_EQ(figures.differences.largest(), 1);
}

TEST(Gate, NamesRuleFigurePlaceAndLimit) {
  Figures figures;
  figures.flip_mean = 0.07;
  figures.flip_tile = {{192, 96, 16, 12}, 0.2221899};
  const auto failures = gate_figures(figures);
  ASSERT_EQ(failures.size(), 2U);
  EXPECT_EQ(failures[0].line(), "flip_tile_max 0.2222 at 192,96 (16x12 pixels), limit 0.12");
  EXPECT_EQ(failures[1].line(), "flip_mean 0.07, limit 0.05");
}

TEST(Gate, LimitsAreInclusiveAndOverstepsAreSeen) {
  Figures figures;
  figures.flip_mean = 0.05;
  figures.flip_tile.mean = 0.12;
  EXPECT_TRUE(gate_figures(figures).empty());
  figures.flip_mean = 0.0500000004;
  const auto failures = gate_figures(figures);
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].line(), "flip_mean 0.0500000004, limit 0.05");
  EXPECT_EQ(gate_figures(figures, {.flip_tile_max = 0.1, .flip_mean = 0.06}).front().rule, "flip_tile_max");
}

TEST(Gate, WhatIsNoNumberFails) {
  Figures figures;
  figures.flip_mean = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(gate_figures(figures).size(), 1U);
}

TEST(Gate, AlphaIsHeldToTheSameLimits) {
  Figures figures;
  figures.alpha = AlphaFigures{0.01, 1, {{16, 0, 16, 16}, 0.5}};
  const auto failures = gate_figures(figures);
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].line(), "alpha_tile_max 0.5 at 16,0 (16x16 pixels), limit 0.12");
}

TEST(Gate, Kinds) {
  const PictureKind kind{64, 48, 8, 3};
  EXPECT_TRUE(gate_kinds(kind, kind).empty());
  const auto failures = gate_kinds(kind, {32, 32, 16, 4});
  ASSERT_EQ(failures.size(), 3U);
  EXPECT_EQ(failures[0].line(), "size 64x48 against 32x32");
  EXPECT_EQ(failures[1].line(), "bit_depth 8 against 16");
  EXPECT_EQ(failures[2].line(), "channels RGB against RGB and alpha");
  EXPECT_EQ(gate_kinds(kind, {64, 48, 8, 1}).front().line(), "channels RGB against grey");
}

TEST(Gate, KindsOfHeadersAndOfPixelsAgree) {
  const std::string bytes = tests::file_bytes(tests::flip_path("png/edge_ref.png"));
  EXPECT_TRUE(gate_kinds(kind_of(read_png_header(bytes, "a")), kind_of(read_png(bytes, "a"))).empty());
}

}  // namespace gate_test
}  // namespace lagomorph::render
