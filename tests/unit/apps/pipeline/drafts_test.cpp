#include <filesystem>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "apps/npy.h"
#include "apps/run/draft.h"
#include "apps/scene/scene.h"
#include "render/png_read.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// Parts of sequences and of pictures: --every, --half, --region.
namespace lagomorph::tests {
namespace drafts_test {

namespace fs = std::filesystem;

render::Pixels read(const fs::path& file) { return render::read_png(read_all(file), file.string()); }

class Drafts : public ProgramRun {
protected:
  void SetUp() override { backend_ = "raster"; }
  fs::path picture(const std::string& run, int frame) const {
    return at(run) / ("frames/frame_000" + std::to_string(frame) + ".png");
  }
};

TEST_F(Drafts, EveryOtherPicture) {
  expect(0, run("whole"));
  expect(0, run("r", {"--every", "2", "--frames", "1..3"}));
  EXPECT_EQ(count_files(at("r") / "frames"), 2);
  EXPECT_EQ(count_files(at("r") / "states"), 4);
  for (const int frame : {1, 3}) EXPECT_EQ(read_all(picture("r", frame)), read_all(picture("whole", frame)));
  expect(0, render("r", {"--every", "3"}));
  EXPECT_TRUE(fs::exists(picture("r", 0)));
  EXPECT_FALSE(fs::exists(picture("r", 2)));
  expect(0, simulate("gap"));
  fs::remove(at("gap") / "states/frame_0001.npy");
  expect(0, render("gap", {"--every", "2", "--frames", "0..3", "-o", at("over").string()}));
  EXPECT_EQ(read_all(picture("over", 2)), read_all(picture("whole", 2))) << "whose states are there";
  expect(2, render("gap", {"--every", "1", "--frames", "0..3", "-o", at("other").string()}));
  expect(0, run("r"));
  expect_same_run(at("whole"), at("r"));
}

TEST_F(Drafts, AVideoOfEveryOtherPicture) {
  if (run_program({"run", data_file("run/bar.toml").string(), "--frames", "0", "--video", "--backend", "null",
                   "-o", at("try").string(), "--quiet"})
          .status == 4)
    GTEST_SKIP() << "ffmpeg is not on the PATH";
  expect(0, run("r", {"--every", "2", "--codec", "gif"}));
  EXPECT_TRUE(fs::exists(at("r") / "bar.gif"));
  EXPECT_EQ(run_json("r").at("video").at("file"), "bar.gif");
  expect(0, run("r", {"--every", "2", "--codec", "webp"}));
  EXPECT_TRUE(fs::exists(at("r") / "bar.webp"));
  EXPECT_FALSE(fs::exists(at("r") / "bar.gif")) << "a run has one video";
}

/// The pixels of a region are those of the whole picture, and so are its channels and what is written over
/// it.
TEST_F(Drafts, ARegionIsAPartOfThePicture) {
  const Arguments look = {"--set", "caption.text=frame {frame}", "--set", "body.0.look.field=displacement",
                          "--set", "body.0.look.range=[0, 0.01]"};
  for (const Arguments& how :
       {Arguments{"--backend", "raster"}, Arguments{"--backend", "path"},
        Arguments{"--backend", "path", "--set", "render.path.noise_threshold=0.05", "--set",
                  "render.path.min_samples=2", "--set", "camera.shutter=0.5"}}) {
    const Arguments one = look + how + Arguments{"--frames", "2"};
    expect(0, run("whole", one + Arguments{"--force"}));
    expect(0, run("part", one + Arguments{"--force", "--region", "13,5,50,43"}));
    const render::Pixels whole = read(picture("whole", 2)), part = read(picture("part", 2));
    ASSERT_EQ(part.width, 37);
    ASSERT_EQ(part.height, 38);
    const auto& all = std::get<std::vector<std::uint8_t>>(whole.samples);
    const auto& some = std::get<std::vector<std::uint8_t>>(part.samples);
    const std::string depths = "aov/depth/frame_0002.npy";
    const apps::NpyFloats far = apps::read_npy_floats(read_all(at("whole") / depths), "whole"),
                          near = apps::read_npy_floats(read_all(at("part") / depths), "part");
    ASSERT_EQ(near.shape, (std::vector<std::size_t>{38, 37}));
    for (std::size_t y = 0; y < 38; ++y) {
      for (std::size_t x = 0; x < 37; ++x) {
        const std::size_t from = (y + 5) * 64 + x + 13, to = y * 37 + x;
        for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(some[3 * to + c], all[3 * from + c]) << x << " " << y;
        ASSERT_EQ(near.values[to], far.values[from]) << x << " " << y;
      }
    }
  }
}

TEST_F(Drafts, NeverPassForThePicture) {
  expect(0, run("r"));
  EXPECT_NE(expect(2, run("r", {"--half"})).find("is another run: render.width 64 -> 32"), std::string::npos);
  EXPECT_NE(expect(2, run("r", {"--region", "0,0,8,8"})).find("is another run: render.region"),
            std::string::npos);
  expect(0, render("r", {"--half"}));
  const render::Pixels half = read(at("r-half") / "frames/frame_0001.png");
  EXPECT_EQ(half.width, 32);
  EXPECT_EQ(half.height, 24);
  expect(0, render("r", {"--half", "--region", "3,4,31,33"}));
  const render::Pixels part = read(at("r-half-region") / "frames/frame_0001.png");
  EXPECT_EQ(part.width, 15) << "pixels 1 .. 15 of the half";
  EXPECT_EQ(part.height, 15);
  EXPECT_EQ(read(picture("r", 1)).width, 64);
  EXPECT_NE(
      expect(2, run("other", {"--region", "0,0,65,8"})).find("must be in the picture of 64 x 48 pixels"),
      std::string::npos);
  EXPECT_NE(expect(2, run("other", {"--region", "0,0,8,8", "--backend", "path", "--set",
                                    "render.channels=['tile_statistics']"}))
                .find("'tile_statistics' is of whole pictures, not of a region"),
            std::string::npos);
}

TEST(DraftFolder, StandsBesideTheRun) {
  apps::Options options;
  options.half = true;
  EXPECT_EQ(apps::draft_folder("out/a/", options), "out/a-half");
  options.region = std::vector<int>{0, 0, 1, 1};
  EXPECT_EQ(apps::draft_folder("out/a", options), "out/a-half-region");
  EXPECT_EQ(apps::draft_folder("out/a", {}), "out/a");
}

TEST(DraftScene, HasAQuarterOfTheSamples) {
  const std::vector<std::string> set = {"render.samples=64", "render.width=65"};
  apps::Options options;
  options.half = true;
  const apps::SceneDesc half = apps::load_scene_as_drawn(data_file("run/bar.toml"), set, options);
  EXPECT_EQ(half.render.samples, 16);
  EXPECT_EQ(half.render.width, 33);
}

}  // namespace drafts_test
}  // namespace lagomorph::tests
