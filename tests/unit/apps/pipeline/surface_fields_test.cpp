#include "apps/pipeline/surface_fields.h"

#include <cmath>

#include <gtest/gtest.h>

#include "apps/pipeline/build_scene.h"
#include "apps/scene/scene.h"
#include "tests/support/run_tree.h"

namespace lagomorph::apps {
namespace surface_fields_test {

using Range = std::array<double, 2>;

/// The small bar with some scalar field, at rest.
struct Shown {
  explicit Shown(const std::vector<std::string>& overrides)
      : scene(load_scene(tests::data_file("run/bar.toml"), overrides)),
        model(build_model(scene, quiet)),
        surfaces(build_surfaces(scene, model, quiet)),
        fields(scene, model, surfaces),
        X(model.initial_state().q) {}

  Progress quiet{true};
  SceneDesc scene;
  sim::Model model;
  std::vector<sim::Surface> surfaces;
  SurfaceFields fields;
  sim::VecX X;
};

TEST(SurfaceFields, NoneAreShownByDefault) {
  const Shown bar({});
  EXPECT_TRUE(bar.fields.is_empty());
  EXPECT_FALSE(bar.fields.is_automatic());
  EXPECT_FALSE(has_automatic_range(bar.scene));
  EXPECT_TRUE(bar.fields.ranges().empty());
  EXPECT_TRUE(bar.fields.bars().empty());
  EXPECT_TRUE(bar.fields.colors(bar.X).at(0).empty());
}

/// A simple shear's displacement is linear in y: so are its values, on the boundary and on the fine mesh.
TEST(SurfaceFields, ALinearFieldHasItsColors) {
  for (const char* const mesh : {"body.0.look.color_bar=true", "body.0.surface.mesh=''"}) {
    const Shown bar({"body.0.look.field=displacement", "body.0.look.colormap=plasma",
                     "body.0.look.range=[0.0, 0.25]", mesh});
    EXPECT_FALSE(bar.fields.is_automatic());
    sim::VecX q = bar.X;
    for (Eigen::Index i = 0; i < q.size(); i += 3) q[i] += 0.4 * q[i + 1];
    const auto colors = bar.fields.colors(q).at(0);
    const sim::Points at = bar.surfaces[0].positions(bar.X);
    ASSERT_EQ(static_cast<Eigen::Index>(colors.size()), at.rows());
    const render::Colormap& map = render::find_colormap("plasma");
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const double y = at(static_cast<Eigen::Index>(i), 1);
      const render::Color expected = render::color_of(map, static_cast<float>(0.4 * y / 0.25));
      EXPECT_LT((colors[i] - expected).abs().maxCoeff(), 1e-5F) << y;
    }
  }
}

TEST(SurfaceFields, AnAutomaticRangeIsThatOfAllThatWasSeen) {
  Shown bar({"body.0.look.field=displacement", "body.0.surface.mesh=''"});
  EXPECT_TRUE(bar.fields.is_automatic());
  EXPECT_TRUE(has_automatic_range(bar.scene));
  EXPECT_EQ(bar.fields.ranges().at("bar"), (Range{0.0, 1.0}));
  bar.fields.see(bar.X);
  EXPECT_EQ(bar.fields.ranges().at("bar"), (Range{0.0, 1.0})) << "all the same";
  for (const double shift : {0.3, 0.7, 0.5}) {
    sim::VecX q = bar.X;
    for (Eigen::Index i = 2; i < q.size(); i += 3) q[i] += shift;
    bar.fields.see(q);
  }
  const Range range = bar.fields.ranges().at("bar");
  EXPECT_EQ(range[0], 0.0);
  EXPECT_NEAR(range[1], 0.7, 1e-15);
}

/// A volume that grows by the half and one that shrinks by a tenth: 1 stands in the middle, and is grey.
TEST(SurfaceFields, VolumeRatiosAreEvenAroundOne) {
  Shown bar({"body.0.look.field=J"});
  bar.fields.see(bar.X * std::cbrt(0.9));
  bar.fields.see(bar.X * std::cbrt(1.5));
  const Range range = bar.fields.ranges().at("bar");
  EXPECT_NEAR(range[0], 0.5, 1e-12);
  EXPECT_NEAR(range[1], 1.5, 1e-12);
  const render::Colormap& map = render::find_colormap("coolwarm");
  for (const auto& [J, place] : {std::pair(1.0, 0.5F), std::pair(1.5, 1.0F), std::pair(0.75, 0.25F)}) {
    const auto colors = bar.fields.colors(bar.X * std::cbrt(J));
    for (const render::Color& color : colors.at(0))
      EXPECT_LT((color - render::color_of(map, place)).abs().maxCoeff(), 1e-4F) << J;
  }
  Shown plain({"body.0.look.field=J", "body.0.look.colormap=viridis"});
  plain.fields.see(plain.X * std::cbrt(0.9));
  plain.fields.see(plain.X * std::cbrt(1.5));
  EXPECT_NEAR(plain.fields.ranges().at("bar")[0], 0.9, 1e-12);
}

TEST(SurfaceFields, WhatIsNotANumberIsLeftOut) {
  Shown bar({"body.0.look.field=displacement"});
  sim::VecX q = bar.X;
  for (Eigen::Index i = 2; i < q.size(); i += 3) q[i] += 0.25;
  q[0] = std::nan("");
  bar.fields.see(q);
  const Range range = bar.fields.ranges().at("bar");
  EXPECT_TRUE(std::isfinite(range[0]) && std::isfinite(range[1]) && range[0] < range[1]);
}

TEST(SurfaceFields, BodiesThatShowTheSameShareARangeAndABar) {
  const auto two = [](const std::string& second) {
    const std::string body = "[[body]]\nmesh = 'bar.msh'\nlook = { field = 'displacement' ";
    SceneDesc scene = parse_scene(body + "}\n" + body + second + "}\ntranslate = [1, 0, 0]\n",
                                  tests::data_file("run/two.toml"), {});
    Progress quiet(true);
    const sim::Model model = build_model(scene, quiet);
    const std::vector<sim::Surface> surfaces = build_surfaces(scene, model, quiet);
    SurfaceFields fields(scene, model, surfaces);
    sim::VecX q = model.initial_state().q;
    for (Eigen::Index i = 0; i < q.size(); i += 3) q[i] += q[i] > 0.5 ? 3.0 : 2.0;
    fields.see(q);
    return std::pair(fields.ranges(), fields.bars().size());
  };
  const auto [shared, one_bar] = two("");
  EXPECT_EQ(one_bar, 1U);
  EXPECT_EQ(shared.at("body0"), shared.at("body1"));
  EXPECT_NEAR(shared.at("body0")[0], 2.0, 1e-12);
  EXPECT_NEAR(shared.at("body0")[1], 3.0, 1e-12);
  const auto [apart, two_bars] = two(", colormap = 'magma'");
  EXPECT_EQ(two_bars, 2U);
  EXPECT_NE(apart.at("body0"), apart.at("body1"));
  EXPECT_EQ(two(", range = [0, 9], color_bar = false").second, 1U);
}

/// Numbers of bodies have names, and nothing lies between them.
TEST(SurfaceFields, BodiesAreCategories) {
  const std::string body = "[[body]]\nmesh = 'bar.msh'\nlook = { field = 'body' }\n";
  const SceneDesc scene =
      parse_scene(body + "name = 'soft'\n" + body + "name = 'hard'\n", tests::data_file("run/two.toml"), {});
  Progress quiet(true);
  const sim::Model model = build_model(scene, quiet);
  const std::vector<sim::Surface> surfaces = build_surfaces(scene, model, quiet);
  SurfaceFields fields(scene, model, surfaces);
  fields.see(model.initial_state().q);
  const std::vector<ColorBar> bars = fields.bars();
  ASSERT_EQ(bars.size(), 1U);
  EXPECT_EQ(bars[0].title, "body");
  EXPECT_EQ((std::array{bars[0].low, bars[0].high}), (Range{0.0, 1.0}));
  ASSERT_EQ(bars[0].categories.size(), 2U);
  EXPECT_EQ(bars[0].categories[0].name, "soft");
  EXPECT_EQ(bars[0].categories[1].name, "hard");
  EXPECT_EQ(bars[0].categories[1].value, 1.0);
  const Shown other({"body.0.look.field=displacement", "body.0.look.range=[0, 1]"});
  EXPECT_TRUE(other.fields.bars().at(0).categories.empty());
}

/// The titles of two bars, some of their looks given.
std::vector<std::string> titles(const std::string& first, const std::string& second) {
  const std::string body = "[[body]]\nmesh = 'bar.msh'\nlook = { field = ";
  const SceneDesc scene =
      parse_scene(body + first + " }\nname = 'soft'\n" + body + second + " }\nname = 'hard'\n",
                  tests::data_file("run/two.toml"), {});
  Progress quiet(true);
  const sim::Model model = build_model(scene, quiet);
  const std::vector<sim::Surface> surfaces = build_surfaces(scene, model, quiet);
  std::vector<std::string> all;
  for (const ColorBar& bar : SurfaceFields(scene, model, surfaces).bars()) all.push_back(bar.title);
  return all;
}

TEST(SurfaceFields, BarsNameTheirBodiesUnlessOneStandsForAll) {
  using Titles = std::vector<std::string>;
  EXPECT_EQ(titles("'displacement'", "'displacement'"), (Titles{"displacement"}));
  EXPECT_EQ(titles("'displacement'", "'displacement', colormap = 'magma'"),
            (Titles{"soft: displacement", "hard: displacement"}));
  EXPECT_EQ(titles("'displacement', range = [0, 1]", "'displacement', range = [0, 2]"),
            (Titles{"soft: displacement", "hard: displacement"}));
  EXPECT_EQ(titles("'displacement'", "'none'"), (Titles{"displacement"}));
  EXPECT_EQ(titles("'displacement', color_bar = false", "'J'"), (Titles{"hard: volume ratio J"}));
}

/// Moved by 0.25 as a whole.
TEST(SurfaceFields, BarsTellValuesBeyondAGivenRange) {
  const auto bar_of = [](const std::string& range) {
    Shown bar({"body.0.look.field=displacement", range});
    sim::VecX q = bar.X;
    for (Eigen::Index i = 2; i < q.size(); i += 3) q[i] += 0.25;
    for (const bool seen : {false, true}) {  // whatever was seen before
      if (seen) bar.fields.see(2.0 * q);
      const ColorBar told = bar.fields.bars(q).at(0), plain = bar.fields.bars().at(0);
      EXPECT_FALSE(plain.below || plain.above);
      EXPECT_EQ(told.given, plain.given);
      if (seen) return told;
    }
    return ColorBar{};
  };
  const auto told = [&](const std::string& range) {
    const ColorBar bar = bar_of("body.0.look.range=" + range);
    EXPECT_TRUE(bar.given);
    return std::pair(bar.below, bar.above);
  };
  EXPECT_EQ(told("[0, 1]"), std::pair(false, false));
  EXPECT_EQ(told("[0, 0.2]"), std::pair(false, true));
  EXPECT_EQ(told("[0.3, 0.4]"), std::pair(true, false));
  EXPECT_EQ(told("[0, 0.25]"), std::pair(false, false)) << "but for rounding";
  const ColorBar automatic = bar_of("body.0.look.color_bar=true");
  EXPECT_FALSE(automatic.given || automatic.below || automatic.above);
  Shown shear({"body.0.look.field=displacement", "body.0.look.range=[0.01, 0.1]"});
  sim::VecX q = shear.X;
  for (Eigen::Index i = 0; i < q.size(); i += 3) q[i + 1] += 2.0 * q[i];
  const ColorBar both = shear.fields.bars(q).at(0);
  EXPECT_TRUE(both.below && both.above);
  EXPECT_FALSE(shear.fields.bars(shear.X).at(0).above) << "of the positions only";
}

TEST(SurfaceFields, BarsTellTheFieldAndItsUnit) {
  const Shown bar({"body.0.look.field=von_mises", "body.0.look.range=[0, 2000.0]"});
  const std::vector<ColorBar> bars = bar.fields.bars();
  ASSERT_EQ(bars.size(), 1U);
  EXPECT_EQ(bars[0].title, "von Mises stress");
  EXPECT_EQ(bars[0].unit, "Pa");
  EXPECT_STREQ(bars[0].map->name, "viridis");
  EXPECT_EQ(bars[0].high, 2000.0);
  EXPECT_TRUE(Shown({"body.0.look.field=J", "body.0.look.color_bar=false"}).fields.bars().empty());
}

}  // namespace surface_fields_test
}  // namespace lagomorph::apps
