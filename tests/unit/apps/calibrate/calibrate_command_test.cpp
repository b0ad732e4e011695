#include "tests/support/check_fixture.h"
#include "tests/support/paths.h"

/// `lagomorph check --calibrate` of pictures of the committed states.
namespace lagomorph::tests {
namespace calibrate_command_test {

using Json = nlohmann::json;

class CalibrateCommand : public CheckFixture {
protected:
  /// Frame 2 of the committed states, small.
  void draw(const std::string& backend, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "render",          lagomorph::tests::source_dir().string() + "/tests/golden/states",
        "--backend",       backend,
        "--frames",        "2",
        "--out",           at("run").string(),
        "--quiet",         "--set",
        "render.width=96", "--set",
        "render.height=54"};
    for (const std::string& set : more) arguments.insert(arguments.end(), {"--set", set});
    const Ended ended = run_program(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  Ended calibrate(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"--calibrate", "--frames", "2"});
    return check(more);
  }
};

TEST_F(CalibrateCommand, ProposesLimitsThatPassSeedsAndFailFaults) {
  draw("path", {"render.samples=16"});
  const Ended ended = calibrate({"--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("frame 2: seed 4\n"), std::string::npos);  // progress is not on stdout
  const Json json = Json::parse(ended.out);
  EXPECT_EQ(json.at("written"), at("run/check/calibration.toml").string());
  EXPECT_FALSE(std::filesystem::exists(at("golden")));
  EXPECT_FALSE(std::filesystem::exists(at("run/check/report.json")));
  int harmless = 0, faults = 0;
  for (const Json& c : json.at("cases")) {
    const Json& figures = c.at("figures");
    bool passes = true;
    for (const auto& [name, most] : json.at("limits").items())
      passes = passes && (figures.count(name) == 0 || most == "off" || figures.at(name) <= most);
    EXPECT_EQ(passes, c.at("harmless")) << c;
    ++(c.at("harmless").get<bool>() ? harmless : faults);
    const std::string name = c.at("name");
    EXPECT_EQ(figures.at("equal"), name == "1 thread" || name == "2 threads") << c;
  }
  EXPECT_EQ(harmless, 6);
  EXPECT_EQ(faults, 5);
}

TEST_F(CalibrateCommand, WritesToTheGoldenOnlyOnYes) {
  draw("raster");
  ASSERT_EQ(run_program({"approve", at("run").string(), at("golden").string()}).status, 0);
  const std::string before = read_all(at("golden/golden.toml"));
  const Ended told = calibrate({"--quiet"});
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_EQ(told.out + told.err, "");
  EXPECT_EQ(read_all(at("golden/golden.toml")), before);
  const Ended ended = calibrate({"--yes"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("faults, at least\n  1 pixel "), std::string::npos) << ended.out;
  EXPECT_NE(read_all(at("golden/golden.toml")), before);
  EXPECT_EQ(check({"--frames", "2"}).status, 0);  // and check reads it
}

TEST_F(CalibrateCommand, RefusesWhatItCannotCalibrate) {
  draw("path", {"render.samples=1", "render.width=24", "render.height=14"});
  // All but a corner of the ground is masked: no fault is in it.
  limits("[[mask]]\nrectangle = [0, 0, 24, 13]\n[[mask]]\nrectangle = [2, 13, 22, 1]\n");
  const Ended ended = calibrate();
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_NE(ended.err.find("lagomorph: no room for limits: removed cluster: flip_tile_max"),
            std::string::npos)
      << ended.err;
  EXPECT_FALSE(std::filesystem::exists(at("run/check")));
  std::filesystem::remove_all(at("run/states"));
  EXPECT_EQ(calibrate().status, 2);
  EXPECT_EQ(check({"--yes"}).status, 2);
}

}  // namespace calibrate_command_test
}  // namespace lagomorph::tests
