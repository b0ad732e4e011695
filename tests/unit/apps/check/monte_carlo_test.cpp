#include <cmath>

#include <fmt/format.h>

#include "apps/npy.h"
#include "tests/support/check_fixture.h"
#include "tests/support/paths.h"

/// The preset mc of `lagomorph check`, on pictures that are path-traced from the committed states.
namespace lagomorph::tests {
namespace monte_carlo_test {

using Json = nlohmann::json;

class MonteCarlo : public CheckFixture {
protected:
  /// Frame 2 of the committed states, small, with statistics.
  void draw(const std::string& name, int samples, int seed, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {
        "render",    lagomorph::tests::source_dir().string() + "/tests/golden/states",
        "--backend", "path",
        "--frames",  "2",
        "--out",     at(name).string(),
        "--quiet",   "--force"};
    more.insert(more.begin(),
                {"render.width=80", "render.height=45", fmt::format("render.samples={}", samples),
                 fmt::format("render.path.seed={}", seed)});
    if (with_statistics_) more.emplace_back("render.channels=[\"tile_statistics\"]");
    for (const std::string& set : more) arguments.insert(arguments.end(), {"--set", set});
    const Ended ended = run_program(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  /// The first frame of the report.
  Json frame(int status, const std::vector<std::string>& more = {"--preset", "mc"}) const {
    return report(status, more).at("frames").at(0);
  }

  bool with_statistics_ = true;
};

const std::vector<std::string> brighter = {"light.0.radiance=18.09", "light.1.radiance=14.07",
                                           "sky.strength=0.5025",
                                           "background.color=[0.4824, 0.427125, 0.3618]"};

TEST_F(MonteCarlo, SeesHalfAPercentThatTheLimitsOnPicturesPass) {
  draw("golden", 256, 1);
  draw("run", 16, 2);
  const Json same = frame(0).at("figures");
  EXPECT_LT(std::abs(same.at("mc_global_z").get<double>()), 5);
  EXPECT_GE(same.at("mc_false_discovery"), 0.001);
  EXPECT_EQ(same.at("mc_tiles"), 60);
  draw("run", 16, 2, brighter);
  const Json bright = frame(1);
  EXPECT_EQ(bright.at("failures").at(1).at("rule"), "mc_global_z");
  EXPECT_NE(bright.at("failures")
                .at(1)
                .at("line")
                .get<std::string>()
                .find("brighter by 0.5 %, limit 5 by preset mc"),
            std::string::npos)
      << bright.at("failures").at(1).at("line");
  EXPECT_EQ(frame(0, {"--preset", "mc", "--set", "limits.mc_global_z=off", "--set",
                      "limits.mc_false_discovery=off"})
                .at("figures")
                .count("mc_global_z"),
            0U);
}

TEST_F(MonteCarlo, WithoutStatisticsThePicturesDecideAndTheResultSaysSo) {
  draw("golden", 16, 1);
  with_statistics_ = false;
  draw("run", 16, 2, brighter);
  const Ended ended = check({"--preset", "mc"});
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(
      ended.out.find("remark: the light's noise was not tested in frames 2: of tile_statistics the run has "
                     "none; the other limits decided"),
      std::string::npos)
      << ended.out;
  EXPECT_EQ(frame(0).at("figures").count("mc_global_z"), 0U);
  EXPECT_EQ(report(0).at("remarks").size(), 0U);  // nobody asked
}

// Metal at 2 samples against 64 is noisier than limits on pictures can allow; the test knows it for noise.
TEST_F(MonteCarlo, StatisticsTellStrongNoiseFromAFault) {
  const std::vector<std::string> metal = {"body.0.look.metallic=1", "body.0.look.roughness=0.1"};
  draw("golden", 64, 1, metal);
  draw("run", 2, 2, metal);
  const Json passed = frame(0);
  EXPECT_GT(passed.at("figures").at("flip_tile_max"), 0.2);
  // A limit that the golden or the command line sets stays as it is.
  EXPECT_EQ(rules(report(1, {"--preset", "mc", "--set", "limits.flip_tile_max=0.2"})),
            (Json{{"2", {"flip_tile_max"}}}));
  std::filesystem::remove_all(at("golden/aov"));
  EXPECT_NE(rules(report(1, {"--preset", "mc"})).at("2").dump().find("flip_tile_max"), std::string::npos);
  // What lies after the light is still seen.
  draw("golden", 64, 1, metal);
  draw("run", 64, 2, {metal[0], metal[1], "render.exposure=0.1"});
  EXPECT_EQ(rules(report(1, {"--preset", "mc"})).at("2").dump(), R"(["flip_mean","bias_mean"])");
}

TEST_F(MonteCarlo, OneSampleAPixelTestsNothing) {
  draw("golden", 16, 1);
  draw("run", 1, 2);
  const Json result = report(0, {"--preset", "mc"});
  EXPECT_NE(
      result.at("remarks").at(0).get<std::string>().find("the run has a sample a pixel, and so no variance"),
      std::string::npos)
      << result.at("remarks");
}

TEST_F(MonteCarlo, BrokenStatisticsFailByName) {
  draw("golden", 4, 1);
  draw("run", 4, 2);
  const std::string whole = read_all(at("run/aov/tile_statistics/frame_0002.npy"));
  dir_.write("run/aov/tile_statistics/frame_0002.npy", whole.substr(0, whole.size() - 1));
  EXPECT_EQ(rules(report(1, {"--preset", "mc"})), (Json{{"2", {"statistics"}}}));
  const std::vector<float> values(8 * 6 * 9);
  dir_.write("run/aov/tile_statistics/frame_0002.npy",
             apps::npy_bytes(values, std::vector<std::size_t>{6, 9, 8}));
  const Json failure = frame(1).at("failures").at(0);
  EXPECT_EQ(failure.at("rule"), "statistics");
  EXPECT_NE(failure.at("found").get<std::string>().find("has the shape (6, 9, 8); (6, 10, 8) would be right"),
            std::string::npos)
      << failure;
}

TEST_F(MonteCarlo, ApprovingTakesTheStatisticsAlong) {
  const auto approve = [&](std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"approve", at("run").string(), at("golden").string()});
    const Ended ended = run_program(more);
    EXPECT_EQ(ended.status, 0) << ended.err;
  };
  const std::string name = "aov/tile_statistics/frame_0002.npy";
  draw("run", 4, 1);
  approve();
  EXPECT_EQ(read_all(at("golden") / name), read_all(at("run") / name));
  approve({"--variant", "other", "--force"});
  EXPECT_EQ(read_all(at("golden/variants/other") / name), read_all(at("run") / name));
  with_statistics_ = false;
  draw("run", 4, 2);
  approve({"--force"});
  EXPECT_FALSE(std::filesystem::exists(at("golden") / name));  // they were of another picture
}

}  // namespace monte_carlo_test
}  // namespace lagomorph::tests
