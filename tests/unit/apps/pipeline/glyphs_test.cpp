#include "apps/pipeline/glyphs.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/labels.h"
#include "apps/pipeline/overlays.h"
#include "apps/scene/scene.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// Signs and numbers on the small bar, which is 0.6 m high and held by its top.
namespace lagomorph::apps {
namespace glyphs_test {

struct Bar {
  explicit Bar(const std::vector<std::string>& overrides)
      : scene(load_scene(tests::data_file("run/bar.toml"), overrides)),
        model(build_model(scene, quiet)),
        surfaces(drawn_surfaces(scene, model, quiet)),
        overlays(scene, model, surfaces),
        state(model.initial_state()) {}

  render::Picture picture(int width = 160, int height = 120) const {
    render::Picture drawn{width, height, {}};
    drawn.rgb.assign(static_cast<std::size_t>(3 * width * height), 128);
    overlays.draw(drawn, render::Camera(scene.camera, width, height), state);
    return drawn;
  }
  /// Rows of the first and the last pixel that is not grey; none: 0 and -1.
  std::array<int, 2> rows() const {
    const render::Picture drawn = picture();
    std::array<int, 2> found = {0, -1};
    for (int i = 0; i < static_cast<int>(drawn.rgb.size()); ++i) {
      if (drawn.rgb[static_cast<std::size_t>(i)] == 128) continue;
      const int row = i / (3 * drawn.width);
      found = {found[1] < 0 ? row : found[0], row};
    }
    return found;
  }

  Progress quiet{true};
  SceneDesc scene;
  sim::Model model;
  std::vector<sim::Surface> surfaces;
  Overlays overlays;
  sim::State state;
};

TEST(Glyphs, NoneByDefault) {
  const Bar bar({});
  EXPECT_TRUE(Glyphs(bar.scene, bar.model, bar.surfaces).is_empty());
  EXPECT_EQ(bar.rows()[1], -1);
  EXPECT_FALSE(needs_sequence(bar.scene));
}

TEST(Glyphs, PinsAreWhereTheyHold) {
  const Bar bar({"glyphs.pins=true"});
  const render::Camera camera(bar.scene.camera, 160, 120);
  const auto [first, last] = bar.rows();
  ASSERT_GT(last, first);
  // The upper tenth: y = 0.6, and nothing below y = 0.54.
  EXPECT_LT(last, camera.project({0.0F, 0.54F, 0.1F}).y() + 6.0F);
  EXPECT_GT(first, camera.project({0.0F, 0.6F, 0.1F}).y() - 12.0F);
  EXPECT_EQ(Bar({"glyphs.pins=true", "body.0.pin=[]"}).rows()[1], -1);
  // Of pins that hold some axes rings.
  EXPECT_NE(Bar({"glyphs.pins=true", "body.0.pin.0.axes=['x']"}).picture().rgb, bar.picture().rgb);
  // After their release none.
  Bar released({"glyphs.pins=true", "body.0.pin.0.release=0.5"});
  EXPECT_NE(released.rows()[1], -1);
  released.state.t = 0.75;
  EXPECT_EQ(released.rows()[1], -1);
}

TEST(Glyphs, ArrowsOfLoadsScaleWithTheForce) {
  const std::vector<std::string> pull = {
      "body.0.load=[{ bottom = 0.1, force = [0, -3, 0], curve = [[0, 1], [1, 2]] }]", "glyphs.loads=total"};
  Bar bar(pull);
  const Glyphs glyphs(bar.scene, bar.model, bar.surfaces);
  const double diagonal = std::sqrt(0.6 * 0.6 + 2 * 0.2 * 0.2);
  // The largest is 6 N, at the curve's end.
  const sim::Points& X = bar.model.mesh().X;
  const double size = (X.colwise().maxCoeff() - X.colwise().minCoeff()).norm();
  EXPECT_NEAR(size, diagonal, 0.2);
  EXPECT_NEAR(glyphs.force(), 6.0 / (0.22 * size), 1e-9);
  EXPECT_NEAR(glyphs.size(), size / 55.0, 1e-9);
  const int once = bar.rows()[1];
  bar.state.t = 1.0;
  EXPECT_GT(bar.rows()[1], once + 3);
  EXPECT_EQ(Bar({"glyphs.loads=total"}).rows()[1], -1);
  ASSERT_EQ(Bar({"glyphs.loads=total"}).overlays.remarks().size(), 1U);
  EXPECT_EQ(Bar({"glyphs.loads=total"}).overlays.remarks()[0],
            "glyphs.loads has no effect: no body has a load");
  EXPECT_NE(Bar({pull[0], "glyphs.loads=vertices"}).picture().rgb, bar.picture().rgb);
  EXPECT_NEAR(Glyphs(Bar({pull[0], pull[1], "glyphs.force=12"}).scene, bar.model, bar.surfaces).force(), 12.0,
              1e-12);
}

/// What pulls at all of a body pulls from its middle, in front of all, and not from one side today and from
/// another tomorrow.
TEST(Glyphs, ArrowsOfBodyLoadsBeginInTheMiddle) {
  for (const char* acceleration : {"[0, -20, 0]", "[0, -20, 1e-9]", "[1e-9, -20, -1e-9]"}) {
    const Bar bar(
        {"body.0.load=[{ acceleration = " + std::string(acceleration) + " }]", "glyphs.loads=total"});
    const render::Camera camera(bar.scene.camera, 160, 120);
    const auto [first, last] = bar.rows();
    EXPECT_NEAR(first, camera.project({0.0F, 0.3F, 0.0F}).y(), 3.0F) << acceleration;
    EXPECT_GT(last, first + 10) << acceleration;
  }
}

TEST(Glyphs, GravityPullsFromTheCentreOfMass) {
  const Bar bar({"glyphs.gravity=true"});
  const render::Camera camera(bar.scene.camera, 160, 120);
  const auto [first, last] = bar.rows();
  EXPECT_NEAR(first, camera.project({0.0F, 0.3F, 0.0F}).y(), 12.0F);
  EXPECT_GT(last, camera.project({0.0F, 0.25F, 0.0F}).y());
  EXPECT_EQ(Bar({"glyphs.gravity=true", "time.gravity=[0, 0, 0]"}).rows()[1], -1);
}

TEST(Glyphs, DisplacementsGoFromRestToWhereVerticesAre) {
  Bar bar({"glyphs.displacement_every=3"});
  EXPECT_TRUE(needs_sequence(bar.scene));
  EXPECT_EQ(bar.rows()[1], -1);  // at rest
  for (Eigen::Index i = 0; i < bar.state.q.size(); i += 3) bar.state.q[i] += 0.25;
  const Glyphs glyphs(bar.scene, bar.model, bar.surfaces);
  EXPECT_NEAR(glyphs.largest_displacement(bar.state.q), 0.25, 1e-12);
  EXPECT_TRUE(bar.overlays.bars().empty());
  bar.overlays.see(0, {}, bar.state.q);
  EXPECT_EQ(bar.overlays.ranges().at("glyphs.displacement")[1], glyphs.largest_displacement(bar.state.q));
  ASSERT_EQ(bar.overlays.bars().size(), 1U);
  EXPECT_EQ(bar.overlays.bars()[0].title, "displacement");
  EXPECT_NE(bar.rows()[1], -1);
}

TEST(Labels, NumbersAreThoseOfSelectors) {
  const Bar bar({"body.0.labels.vertices=true"});
  const Labels labels(bar.scene, bar.model, bar.surfaces, 0);
  EXPECT_FALSE(labels.is_empty());
  EXPECT_FALSE(labels.remark("bar"));
  EXPECT_NE(bar.rows()[1], -1);
  EXPECT_NE(bar.picture().rgb, Bar({"body.0.labels.faces=true"}).picture().rgb);
  EXPECT_NE(bar.picture().rgb, Bar({"body.0.labels={ vertices = true, of = 'surface' }"}).picture().rgb);
}

TEST(Labels, ThatAreNotAllThereAreTold) {
  const Bar bar({"body.0.labels={ vertices = true, faces = true, most = 25 }"});
  ASSERT_EQ(bar.overlays.remarks().size(), 1U);
  EXPECT_EQ(bar.overlays.remarks()[0],
            "bar: every 3rd of 58 vertices and every 5th of 112 faces has its number in the picture, at most "
            "labels.most of each");
}

class SequenceOverlays : public tests::ProgramRun {
protected:
  void SetUp() override { backend_ = "raster"; }
  const tests::Arguments plot_ = {"--set", "energy_plot.show=true", "--set", "glyphs.displacement_every=5",
                                  "--set", "render.width=320",      "--set", "render.height=180"};
};

TEST_F(SequenceOverlays, AreTheSameWholeResumedOrInShards) {
  using tests::operator+;
  expect(0, run("whole", plot_));
  expect(0, run("shards", plot_ + tests::Arguments{"--frames", "0..1"}));
  expect(0, run("shards", plot_));
  tests::expect_same_run(at("whole"), at("shards"));
  expect(0, simulate("apart", plot_));
  expect(0, render("apart", {"--frames", "2..3"}));
  expect(0, render("apart", {"--frames", "0..1"}));
  tests::expect_same_run(at("whole"), at("apart"));
  std::filesystem::remove(at("apart") / "frames/frame_0002.png");
  expect(0, run("apart", plot_ + tests::Arguments{"--threads", "1"}));
  tests::expect_same_run(at("whole"), at("apart"));
  const nlohmann::json ranges = run_json("whole").at("frames").at(0).at("ranges");
  EXPECT_EQ(ranges.at("energy_plot.time"), (nlohmann::json{0.0, 0.1}));
  EXPECT_GT(ranges.at("glyphs.displacement").at(1).get<double>(), 0.0);
  const auto before = tests::tree(at("apart"));
  expect(0, run("apart", plot_));
  EXPECT_EQ(tests::tree(at("apart")), before);
}

/// Records tell the axis, so that pictures of another are known.
TEST_F(SequenceOverlays, TheDiagramHasTheRangeOfItsCurvesOrTheOneGiven) {
  using tests::operator+;
  expect(0, run("all", plot_));
  expect(0, run("elastic", plot_ + tests::Arguments{"--set", "energy_plot.curves=['elastic']"}));
  expect(0, run("given", plot_ + tests::Arguments{"--set", "energy_plot.range=[-1,2.5]"}));
  const auto range = [&](const char* name) {
    return run_json(name).at("frames").at(0).at("ranges").at("energy_plot.energy");
  };
  std::vector<double> elastic;
  std::istringstream table(tests::read_all(at("all") / "energy.csv"));
  for (std::string line; std::getline(table, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i < 4; ++i) std::getline(cells, cell, ',');
    if (cell != "elastic") elastic.push_back(std::stod(cell));
  }
  ASSERT_EQ(elastic.size(), 4U);
  const auto [low, high] = std::minmax_element(elastic.begin(), elastic.end());
  EXPECT_EQ(range("elastic"), (nlohmann::json{*low, *high}));
  EXPECT_LT(range("all").at(0).get<double>(), *low + 1e-12);
  EXPECT_GT(range("all").at(1).get<double>(), *high) << "the bar's weight";
  EXPECT_EQ(range("given"), (nlohmann::json{-1.0, 2.5}));
}

}  // namespace glyphs_test
}  // namespace lagomorph::apps
