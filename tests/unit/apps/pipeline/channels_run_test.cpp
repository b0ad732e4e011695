#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/npy.h"
#include "render/color.h"
#include "render/png_read.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// Runs that leave channels, and pictures with alpha.
namespace lagomorph::tests {
namespace channels_run_test {

namespace fs = std::filesystem;

class ChannelsRun : public ProgramRun {
protected:
  void SetUp() override { backend_ = "raster"; }

  std::vector<float> channel(const std::string& run, const std::string& name, int frame) const {
    const fs::path file = at(run) / "aov" / name / ("frame_000" + std::to_string(frame) + ".npy");
    return apps::read_npy_floats(read_all(file), file.string()).values;
  }
  render::Pixels picture(const std::string& run, int frame) const {
    const fs::path file = at(run) / "frames" / ("frame_000" + std::to_string(frame) + ".png");
    return render::read_png(read_all(file), file.string());
  }

  /// Of all channels.
  int channel_files(const std::string& run) const {
    const fs::recursive_directory_iterator all(at(run) / "aov");
    return static_cast<int>(std::count_if(
        begin(all), end(all), [](const fs::directory_entry& entry) { return entry.is_regular_file(); }));
  }

  const Arguments motion_ = {"--set", "render.channels=[\"motion\"]"};
};

TEST_F(ChannelsRun, MotionIsTheSameInARunInPartsAndLater) {
  expect(0, run("whole", motion_));
  for (const float v : channel("whole", "motion", 0)) ASSERT_EQ(v, 0.0F);
  double most = 0.0;
  for (const float v : channel("whole", "motion", 1)) most = std::max(most, std::abs(static_cast<double>(v)));
  EXPECT_GT(most, 0.05);  // pixels: half a metre a second
  EXPECT_LT(most, 5.0);
  expect(0, run("parts", motion_ + Arguments{"--frames", "0..1"}));
  expect(0, run("parts", motion_));
  expect_same_run(at("whole"), at("parts"));
  expect(0, simulate("later", motion_));
  expect(0, render("later", {"--frames", "3"}));
  EXPECT_EQ(channel("later", "motion", 3), channel("whole", "motion", 3));
  fs::remove(at("later") / "states/frame_0001.npy");
  const std::string said = expect(2, render("later", {"--frames", "2", "-o", at("other").string()}));
  EXPECT_NE(said.find("frame_0001.npy: is not there"), std::string::npos) << said;
}

TEST_F(ChannelsRun, AnotherFormatReplacesTheFiles) {
  const Arguments both = {"--set", "render.channels=[\"depth\",\"normal\"]"};
  expect(0, run("r", both));
  EXPECT_EQ(channel_files("r"), 8);
  expect(0, run("r", both + Arguments{"--set", "render.channel_format=exr", "--force"}));
  EXPECT_EQ(channel_files("r"), 8);
  EXPECT_TRUE(fs::exists(at("r") / "aov/normal/frame_0003.exr"));
  EXPECT_EQ(read_all(at("r") / "aov/depth/frame_0000.exr").substr(0, 4), "\x76\x2f\x31\x01");
  EXPECT_EQ(run_json("r")["frames"][0]["channels"].size(), 2U);
  const std::string fps("framesPerSecond\0rational\0\x08\0\0\0\x1e\0\0\0\x01\0\0\0", 15 + 1 + 8 + 1 + 12);
  EXPECT_NE(read_all(at("r") / "aov/depth/frame_0000.exr").find(fps), std::string::npos) << "30/1";

  expect(0, run("r", both + Arguments{"--set", "render.channel_format=exr_multilayer", "--force"}));
  EXPECT_EQ(channel_files("r"), 4);
  const fs::path file = at("r") / "aov/multilayer/frame_0002.exr";
  const std::string bytes = read_all(file);
  for (const char* name : {"A", "B", "G", "R", "Z", "normal.X", "normal.Y", "normal.Z"})
    EXPECT_NE(bytes.find(std::string(name) + '\0' + std::string("\x02\0\0\0", 4)), std::string::npos) << name;
  // What is missing or damaged is made again, with the same bytes.
  fs::resize_file(file, 100);
  expect(0, run("r", both + Arguments{"--set", "render.channel_format=exr_multilayer"}));
  EXPECT_EQ(read_all(file), bytes);
}

TEST_F(ChannelsRun, StatisticsStayWhereTheCheckReadsThem) {
  backend_ = "path";
  expect(0, run("r", {"--frames", "0", "--set", "render.channels=[\"depth\",\"tile_statistics\"]", "--set",
                      "render.channel_format=exr_multilayer"}));
  EXPECT_TRUE(fs::exists(at("r") / "aov/tile_statistics/frame_0000.npy"));
  EXPECT_TRUE(fs::exists(at("r") / "aov/multilayer/frame_0000.exr"));
  EXPECT_EQ(channel_files("r"), 2);
}

/// They hold what the arrays do, in both back ends.
TEST_F(ChannelsRun, PngOfWhatFits) {
  const Arguments some = {
      "--frames", "0", "--set",
      "render.channels=[\"normal\",\"albedo\",\"alpha\",\"body_id\",\"triangle_id\",\"depth\"]"};
  for (const char* backend : {"raster", "path"}) {
    backend_ = backend;
    const std::string name = backend;
    expect(0, run(name, some));
    expect(0, run(name + "-png", some + Arguments{"--set", "render.channel_format=png"}));
    EXPECT_EQ(channel_files(name + "-png"), 6);
    const auto samples = [&](const char* of) {
      const fs::path file = at(name + "-png") / "aov" / of / "frame_0000.png";
      return std::get<std::vector<std::uint16_t>>(render::read_png(read_all(file), file.string()).samples);
    };
    const auto normals = samples("normal"), ids = samples("triangle_id"), alphas = samples("alpha"),
               albedos = samples("albedo"), depths = samples("depth");
    const std::vector<float> n = channel(name, "normal", 0), t = channel(name, "triangle_id", 0),
                             a = channel(name, "alpha", 0), c = channel(name, "albedo", 0),
                             z = channel(name, "depth", 0);
    ASSERT_EQ(normals.size(), n.size());
    int seen = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      ASSERT_EQ(ids[3 * i], static_cast<int>(t[i]) + 1);
      ASSERT_NEAR(alphas[3 * i] / 65535.0F, a[i], 1e-5F);
      ASSERT_NEAR(depths[3 * i], std::isinf(z[i]) ? 0.0F : 1000.0F * z[i], 0.501F);
      seen += t[i] >= 0.0F ? 1 : 0;
    }
    EXPECT_GT(seen, 100);
    for (std::size_t i = 0; i < n.size(); ++i) {
      ASSERT_NEAR(normals[i] / 65535.0F, 0.5F + 0.5F * n[i], 1e-5F);
      ASSERT_NEAR(render::linear_from_srgb(albedos[i] / 65535.0F), c[i], 2e-5F);
    }
  }
  // Another format replaces the files.
  expect(0, run("path-png", some + Arguments{"--force"}));
  EXPECT_EQ(channel_files("path-png"), 6);
  EXPECT_TRUE(fs::exists(at("path-png") / "aov/alpha/frame_0000.npy"));
}

TEST_F(ChannelsRun, AFormatWithoutChannelsIsTold) {
  const Ended ended =
      run_program({"run", data_file("run/bar.toml").string(), "--frames", "0", "--set", "render.channels=[]",
                   "--set", "render.channel_format=exr", "-o", at("r").string()});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("render.channel_format = exr has no effect without render.channels"),
            std::string::npos)
      << ended.err;
  expect(2, run("wrong", {"--set", "render.channel_format=tiff"}));
}

TEST_F(ChannelsRun, TransparentPicturesHaveStraightAlpha) {
  for (const char* backend : {"raster", "path"}) {
    backend_ = backend;
    const std::string name = backend;
    const Arguments look = {"--frames", "0",
                            "--set",    "render.channels=[\"alpha\",\"color\"]",
                            "--set",    "render.tone_curve=none",
                            "--set",    "ground.enabled=false",
                            "--set",    "camera.position=[0.5,0.8,1.2]"};
    expect(0, run(name, look + Arguments{"--set", "render.transparent=true"}));
    const render::Pixels pixels = picture(name, 0);
    ASSERT_EQ(pixels.channels, 4);
    const auto& samples = std::get<std::vector<std::uint8_t>>(pixels.samples);
    const std::vector<float> alpha = channel(name, "alpha", 0), color = channel(name, "color", 0);
    int clear = 0, opaque = 0, edge = 0;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      EXPECT_NEAR(samples[4 * i + 3], 255.0F * alpha[i], 0.51F);
      clear += alpha[i] == 0.0F ? 1 : 0;
      opaque += alpha[i] == 1.0F ? 1 : 0;
      if (alpha[i] == 0.0F) {
        EXPECT_EQ(color[3 * i], 0.0F);
        EXPECT_EQ(samples[4 * i], 0);
        continue;
      }
      edge += alpha[i] < 1.0F ? 1 : 0;
      // Not times alpha: an edge is as bright as the surface.
      EXPECT_NEAR(samples[4 * i] / 255.0F, render::srgb_from_linear(color[3 * i] / alpha[i]), 0.003F);
    }
    EXPECT_GT(clear, 500);
    EXPECT_GT(opaque, 100);
    EXPECT_GT(edge, 10);
    // Only what is behind differs from the picture with a background.
    expect(0, run(name + "-opaque", look + Arguments{"--set", "background.color=[0,0,0]"}));
    EXPECT_EQ(channel(name + "-opaque", "color", 0), color);
    EXPECT_EQ(channel(name + "-opaque", "alpha", 0), alpha);
    EXPECT_EQ(picture(name + "-opaque", 0).channels, 3);
  }
}

TEST_F(ChannelsRun, TransparentPicturesAreCheckedPreviewedAndApproved) {
  const Arguments transparent = {"--set", "render.transparent=true", "--set", "caption.text=frame {frame}"};
  expect(0, run("r", transparent));
  expect(0, {"approve", at("r").string(), at("golden").string(), "--quiet"});
  expect(0, {"check", at("r").string(), at("golden").string(), "--quiet"});
  expect(0, {"preview", at("r").string(), "--quiet"});
  EXPECT_TRUE(fs::exists(at("r") / "preview/contact_sheet.png"));
  expect(0, run("opaque", {"--set", "caption.text=frame {frame}"}));
  EXPECT_EQ(run_program({"check", at("opaque").string(), at("golden").string(), "--quiet"}).status, 1);
  expect(0, run("r", transparent + Arguments{"--force", "--set", "body.0.look.base_color=[0.9,0.1,0.1]"}));
  EXPECT_EQ(run_program({"check", at("r").string(), at("golden").string(), "--quiet"}).status, 1);
}

}  // namespace channels_run_test
}  // namespace lagomorph::tests
