#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "apps/npy.h"
#include "render/png_read.h"
#include "tests/support/check_fixture.h"
#include "tests/support/paths.h"

/// `lagomorph compare A.npy B.npy`.
namespace lagomorph::tests {
namespace compare_floats_test {

using Json = nlohmann::json;

class CompareFloats : public CheckFixture {
protected:
  std::string write(const std::string& name, const std::vector<float>& values,
                    const std::vector<std::size_t>& shape) const {
    return dir_.write(name, apps::npy_bytes(values, shape)).string();
  }
  /// Grey light from dark to bright, 40 x 30.
  static std::vector<float> ramp() {
    std::vector<float> values;
    for (int i = 0; i < 1200; ++i) values.push_back(std::exp2(static_cast<float>(i % 40) / 5.0F - 4.0F));
    return values;
  }
  static const inline std::vector<std::size_t> shape = {30, 40};
};

TEST_F(CompareFloats, EqualOnesAndOnesThatDiffer) {
  std::vector<float> values = ramp();
  const std::string a = write("a.npy", values, shape);
  Ended ended = run_program({"compare", a, a, "--json"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  Json json = Json::parse(ended.out);
  EXPECT_TRUE(json.at("equal"));
  EXPECT_EQ(json.at("flip_max"), 0.0);
  EXPECT_EQ(json.at("exposures").at(2), 4);  // from 7.8 - 4 stops down to the median at 3.9 - 4
  for (int y = 10; y < 26; ++y) {
    for (int x = 4; x < 20; ++x) values[static_cast<std::size_t>(40 * y + x)] += 0.125F;
  }
  const std::string b = write("b.npy", values, shape);
  ended = run_program({"compare", a, b, "--json", "--heat", at("heat.png").string()});
  EXPECT_EQ(ended.status, 1) << ended.err;
  json = Json::parse(ended.out);
  EXPECT_FALSE(json.at("same"));
  EXPECT_NEAR(json.at("max_abs").get<double>(), 0.125, 1e-6);
  EXPECT_NEAR(json.at("rmse").get<double>(), 0.125 * std::sqrt(256 / 1200.0), 1e-6);
  EXPECT_TRUE(json.at("ssim").is_null());
  EXPECT_EQ(render::read_png(read_all(at("heat.png")), "heat").width, 40);
  ended = run_program({"compare", a, b});
  EXPECT_NE(ended.out.find("fails by      flip_tile_max"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("HDR-FLIP"), std::string::npos) << ended.out;
}

TEST_F(CompareFloats, InfiniteDepthsAreEqualOrNot) {
  std::vector<float> values = ramp();
  for (std::size_t i = 0; i < 400; ++i) values[i] = std::numeric_limits<float>::infinity();
  const std::string a = write("a.npy", values, shape);
  EXPECT_EQ(run_program({"compare", a, a}).status, 0);
  for (std::size_t i = 0; i < 400; ++i) values[i] = 2;
  EXPECT_EQ(run_program({"compare", a, write("b.npy", values, shape)}).status, 1);
}

TEST_F(CompareFloats, TheRendererLeavesLinearLight) {
  const auto draw = [&](const std::string& name, const std::string& set) {
    const Ended ended =
        run_program({"render", lagomorph::tests::source_dir().string() + "/tests/golden/states", "--frames",
                     "2", "--out", at(name).string(), "--quiet", "--backend", "path", "--set",
                     "render.width=64", "--set", "render.height=36", "--set", "render.samples=8", "--set",
                     "render.channels=[\"color\"]", "--set", set});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return (at(name) / "aov/color/frame_0002.npy").string();
  };
  const std::string own = draw("own", "render.exposure=0");
  const apps::NpyFloats color = apps::read_npy_floats(read_all(own), "color");
  EXPECT_EQ(color.shape, (std::vector<std::size_t>{36, 64, 3}));
  EXPECT_EQ(run_program({"compare", own, draw("exposed", "render.exposure=2")}).status,
            0);  // it is before that
  EXPECT_EQ(run_program({"compare", own, draw("brighter", "light.0.radiance=30")}).status, 1);
}

TEST_F(CompareFloats, OtherSizesAreDifferentByName) {
  const std::string a = write("a.npy", ramp(), shape), b = write("b.npy", ramp(), {40, 30});
  const Ended ended = run_program({"compare", a, b});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.out.find("fails by      size 40x30 against 30x40"), std::string::npos) << ended.out;
  EXPECT_TRUE(Json::parse(run_program({"compare", a, b, "--json"}).out).at("flip_mean").is_null());
}

TEST_F(CompareFloats, RefusesWhatIsNoPicture) {
  const std::string good = write("good.npy", ramp(), shape);
  const auto refusal = [&](const std::string& file) {
    const Ended ended = run_program({"compare", good, file});
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    return ended.err;
  };
  EXPECT_NE(refusal(write("b.npy", ramp(), {1200})).find("has the shape (1200,); (H, W) or (H, W, 3)"),
            std::string::npos);
  EXPECT_NE(refusal(write("b.npy", {}, {0, 40})).find("has the shape (0, 40)"), std::string::npos);
  EXPECT_NE(refusal(dir_.write("b.npy", read_all(good).substr(0, 500)).string()).find("bytes of values"),
            std::string::npos);
  EXPECT_NE(refusal(dir_.write("b.npy", "png?").string()).find("is no npy file"), std::string::npos);
  refusal(at("missing.npy").string());
  dir_.write("b.png", "no");
  refusal(at("b.png").string());
}

}  // namespace compare_floats_test
}  // namespace lagomorph::tests
