#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include <gtest/gtest.h>
#include <toml++/toml.h>

#include "apps/calibrate/calibration.h"
#include "apps/calibrate/faults.h"
#include "apps/error.h"

/// Limits from figures that are made up, and the faults themselves.
namespace lagomorph::apps {
namespace propose_test {

CalibrationCase make(const std::string& name, bool harmless, int frame, double flip_tile, double flip_mean,
                     double bias_tile) {
  CalibrationCase c{.name = name, .harmless = harmless, .result = {}};
  c.result.frame = frame;
  c.result.figures.emplace();
  c.result.figures->flip_tile.mean = flip_tile;
  c.result.figures->flip_mean = flip_mean;
  c.result.bias.emplace();
  c.result.bias->tile.mean = bias_tile;
  return c;
}

std::optional<double> limit(const Proposal& proposal, LimitName name) {
  for (const ProposedLimit& l : proposal.limits) {
    if (l.name == name) return l.value;
  }
  ADD_FAILURE() << "no such limit";
  return std::nullopt;
}

TEST(Calibration, LimitsLieBetweenBothSides) {
  const Proposal proposal = propose_limits(
      {make("seed 1", true, 0, 0.02, 0.01, 0.001), make("seed 1", true, 3, 0.04, 0.01, 0.001),
       make("cast", false, 0, 0.16, 0.011, 0.0011), make("cast", false, 3, 0.30, 0.011, 0.0011)});
  EXPECT_TRUE(proposal.no_room.empty());
  ASSERT_EQ(proposal.limits.size(), 1U);
  EXPECT_DOUBLE_EQ(limit(proposal, LimitName::flip_tile_max).value(), 0.08);  // sqrt(0.04 * 0.16)
  EXPECT_EQ(proposal.limits[0].why,
            "harmless up to 0.04 (seed 1, frame 3), faults from 0.16 (cast, frame 0)");
}

TEST(Calibration, AnotherFigureTellsWhatTheFirstDoesNot) {
  const Proposal proposal =
      propose_limits({make("seed 1", true, 0, 0.10, 0.01, 0.001), make("cast", false, 0, 0.4, 0.011, 0.0011),
                      make("shift", false, 0, 0.11, 0.011, 0.016)});
  EXPECT_TRUE(proposal.no_room.empty());
  EXPECT_DOUBLE_EQ(limit(proposal, LimitName::flip_tile_max).value(), 0.2);
  EXPECT_DOUBLE_EQ(limit(proposal, LimitName::bias_tile_max).value(), 0.004);
}

TEST(Calibration, ThereMayBeNoRoom) {
  const Proposal proposal =
      propose_limits({make("seed 1", true, 0, 0.10, 0.04, 0.01), make("cast", false, 0, 0.4, 0.1, 0.1),
                      make("shift", false, 0, 0.12, 0.05, 0.012)});
  ASSERT_EQ(proposal.no_room.size(), 1U);
  EXPECT_EQ(proposal.no_room[0],
            "shift: flip_tile_max 0.12 (shift, frame 0), while harmless are up to 0.1 (seed 1, frame 0)");
}

TEST(Calibration, ThePresetsOtherLimitsPassWhatIsHarmless) {
  const Proposal proposal =
      propose_limits({make("seed 1", true, 0, 0.10, 0.06, 0.02), make("cast", false, 0, 0.4, 0.07, 0.021)});
  EXPECT_FALSE(limit(proposal, LimitName::flip_mean));
  EXPECT_DOUBLE_EQ(limit(proposal, LimitName::flicker_tile_max).value(), 0.06);
}

TEST(Calibration, WhatElseAGoldenSaysStays) {
  const std::vector<CalibrationCase> cases = {make("seed 1", true, 0, 0.02, 0.01, 0.001),
                                              make("cast", false, 0, 0.16, 0.011, 0.0011)};
  const std::string text =
      proposal_toml(propose_limits(cases), cases,
                    "preset = 'exact'\nextra = 'ignore'\n[limits]\nrmse = 0.1\n[[mask]]\n"
                    "rectangle = [0, 0, 4, 4]\n");
  const toml::table table = toml::parse(text);
  EXPECT_EQ(table["preset"].value_or(""), std::string("render"));
  EXPECT_EQ(table["extra"].value_or(""), std::string("ignore"));
  EXPECT_EQ(table["limits"].as_table()->size(), 1U) << text;
  EXPECT_NEAR(table["limits"]["flip_tile_max"].value_or(0.0), 0.0566, 1e-9);
  EXPECT_EQ(table["mask"][0]["rectangle"].as_array()->size(), 4U) << text;
}

TEST(Faults, OfPicturesAreWhatTheyAreCalled) {
  const render::Picture picture{
      3, 2, {10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120, 130, 140, 150, 240, 250, 255}};
  std::map<std::string, render::Picture> changed;
  for (const PictureChange& change : picture_changes()) changed[change.name] = change.apply(picture);
  EXPECT_EQ(changed.at("1 pixel").rgb, (std::vector<std::uint8_t>{10, 20, 30, 10, 20, 30, 40, 50, 60, 100,
                                                                  110, 120, 100, 110, 120, 130, 140, 150}));
  EXPECT_EQ(changed.at("cast").rgb[3], 44);
  EXPECT_EQ(changed.at("cast").rgb[15], 255);
  EXPECT_EQ(changed.at("cast").rgb[4], 50);
  EXPECT_EQ(changed.at("gamma 1.1").rgb[6], std::lround(255 * std::pow(70 / 255.0, 1.1)));
  int most = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    most = std::max(most, std::abs(changed.at("1 of 255").rgb[i] - picture.rgb[i]));
  EXPECT_EQ(most, 1);
}

TEST(Faults, AClusterIsWhereTheCameraLooks) {
  render::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 2}, {0.1F, 0, 2}, {0, 0.1F, 2}, {9, 0, 2.9F}};
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {0, 4, 3}, {0, 4, 4}};
  render::CameraSettings towards;
  towards.position = {0, 0, 4};
  towards.look_at = {0, 0, 0};
  const render::Camera camera(towards, 64, 64);
  const Cluster cluster = visible_cluster({mesh}, camera, 0);
  EXPECT_EQ(cluster.center, mesh.positions[1]);  // not the one that is nearer, out of the picture
  EXPECT_GT(cluster.radius, 1.0F);
  render::Mesh removed = mesh;
  remove_cluster(removed, cluster);
  ASSERT_EQ(removed.triangles.size(), 1U);
  EXPECT_EQ(removed.triangles[0], mesh.triangles[3]);
  render::Mesh moved = mesh;
  move_cluster(moved, cluster, camera);
  EXPECT_EQ(moved.positions[0], mesh.positions[0]);
  EXPECT_NEAR((moved.positions[1] - mesh.positions[1]).norm(), cluster.radius / 2, 1e-5);
  towards.look_at = {0, 0, 9};
  EXPECT_THROW(visible_cluster({mesh}, render::Camera(towards, 64, 64), 0), Error);
}

}  // namespace propose_test
}  // namespace lagomorph::apps
