#include "apps/scene/panels.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "apps/npy.h"
#include "apps/scene/scene.h"
#include "render/png_read.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// Several pictures in one.
namespace lagomorph::tests {
namespace panels_test {

render::Pixels picture(const std::filesystem::path& run, int frame) {
  const std::filesystem::path file = run / ("frames/frame_000" + std::to_string(frame) + ".png");
  return render::read_png(read_all(file), file.string());
}

/// The part of a picture from (x, y) on.
std::vector<std::uint8_t> part(const render::Pixels& p, int x, int y, int width, int height) {
  const auto& all = std::get<std::vector<std::uint8_t>>(p.samples);
  std::vector<std::uint8_t> some;
  for (int row = y; row < y + height; ++row) {
    const auto begin = all.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{row} * p.width + x);
    some.insert(some.end(), begin, begin + std::ptrdiff_t{3} * width);
  }
  return some;
}

apps::NpyFloats depths(const std::filesystem::path& run) {
  return apps::read_npy_floats(read_all(run / "aov/depth/frame_0002.npy"), "depth");
}

class Panels : public ProgramRun {
protected:
  void SetUp() override { backend_ = "raster"; }
};

/// Each is the picture that a run with its camera and field draws at its size.
TEST_F(Panels, AreThePicturesOfTheirCamerasAndFields) {
  const Arguments size = {"--set", "render.height=40"},
                  second = {"--set", "camera.view=right", "--set", "camera.zoom=1.5"},
                  field = {"--set", "body.0.look.field=displacement", "--set", "body.0.look.color_bar=false"};
  for (const char* const backend : {"raster", "path"}) {
    backend_ = backend;
    const std::string tag = backend;
    expect(0, run("panels" + tag, size + field +
                                      Arguments{"--set", "render.width=84", "--set", "panel.0.field=none",
                                                "--set", "panel.1.view=right", "--set", "panel.1.zoom=1.5"}));
    expect(0, run("first" + tag, size + Arguments{"--set", "render.width=40"}));
    expect(0, run("second" + tag, size + second + field + Arguments{"--set", "render.width=40"}));
    const render::Pixels whole = picture(at("panels" + tag), 2);
    ASSERT_EQ(whole.width, 84);
    // Its colour goes another way to the shader, where vertices of the same mesh have some in the next panel.
    const auto own = part(whole, 0, 0, 40, 40), plain = part(picture(at("first" + tag), 2), 0, 0, 40, 40);
    for (std::size_t i = 0; i < own.size(); ++i) ASSERT_LE(std::abs(own[i] - plain[i]), 1) << backend << i;
    EXPECT_EQ(part(whole, 44, 0, 40, 40), part(picture(at("second" + tag), 2), 0, 0, 40, 40)) << backend;
    EXPECT_EQ(part(whole, 40, 0, 4, 40), std::vector<std::uint8_t>(4 * 40 * 3)) << "the gap";
  }
}

/// What is seen from below leaves the ground out, and the panels beside it keep theirs.
TEST_F(Panels, FromTheBottomHaveNoGround) {
  const Arguments size = {"--set", "render.height=40", "--frames", "0..1"},
                  one = {"--set", "render.width=40"};
  for (const char* const backend : {"raster", "path"}) {
    backend_ = backend;
    const std::string tag = backend;
    const Arguments bottom = {"--set", "camera.view=bottom"};
    expect(0, run("panels" + tag, size + Arguments{"--set", "render.width=84", "--set", "panel.0.view=bottom",
                                                   "--set", "panel.1.zoom=1"}));
    expect(0, run("bottom" + tag, size + one + bottom));
    expect(0, run("side" + tag, size + one));
    const render::Pixels whole = picture(at("panels" + tag), 1), below = picture(at("bottom" + tag), 1);
    EXPECT_EQ(part(whole, 0, 0, 40, 40), part(below, 0, 0, 40, 40)) << backend;
    EXPECT_EQ(part(whole, 44, 0, 40, 40), part(picture(at("side" + tag), 1), 0, 0, 40, 40)) << backend;
    // The same in all panels, where the camera looks from there and a panel does not say otherwise.
    expect(0, run("same" + tag, size + bottom +
                                    Arguments{"--set", "render.width=84", "--set", "panel.0.zoom=1", "--set",
                                              "panel.1.view=none"}));
    const render::Pixels same = picture(at("same" + tag), 1);
    EXPECT_EQ(part(same, 0, 0, 84, 40), part(whole, 0, 0, 84, 40)) << backend;
  }
}

/// Over two of four panels, in one that is not the first, and between them.
TEST_F(Panels, ARegionIsAPartOfThePicture) {
  const Arguments all = {"--frames", "2",
                         "--set",    "render.width=100",
                         "--set",    "render.height=84",
                         "--set",    "caption.text=frame {frame}",
                         "--set",    "panel.0.field=displacement",
                         "--set",    "panel.1.view=right",
                         "--set",    "panel.2.zoom=2",
                         "--set",    "panel.2.title=near",
                         "--set",    "panel.3.field=J",
                         "--set",    "render.channels=['depth']"};
  struct Box {
    int x0, y0, x1, y1;
  };
  for (const Arguments& how : {Arguments{"--backend", "raster"},
                               Arguments{"--backend", "raster", "--set", "render.raster.supersample=2"},
                               Arguments{"--backend", "path", "--set", "render.path.denoise=true"}}) {
    const Arguments one = all + how + Arguments{"--force"};
    expect(0, run("whole", one));
    const render::Pixels whole = picture(at("whole"), 2);
    const apps::NpyFloats far = depths(at("whole"));
    for (const Box& box :
         {Box{31, 50, 77, 80}, Box{59, 5, 81, 33}, Box{60, 3, 90, 30}, Box{48, 10, 52, 70}}) {
      const int width = box.x1 - box.x0, height = box.y1 - box.y0;
      expect(0, run("part",
                    one + Arguments{"--region", fmt::format("{},{},{},{}", box.x0, box.y0, box.x1, box.y1)}));
      const render::Pixels some = picture(at("part"), 2);
      ASSERT_EQ(some.width, width);
      ASSERT_EQ(some.height, height);
      EXPECT_EQ(part(some, 0, 0, width, height), part(whole, box.x0, box.y0, width, height)) << how.at(1);
      const apps::NpyFloats near = depths(at("part"));
      ASSERT_EQ(near.shape, (std::vector<std::size_t>{static_cast<std::size_t>(height),
                                                      static_cast<std::size_t>(width)}));
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          ASSERT_EQ(near.values[static_cast<std::size_t>(y * width + x)],
                    far.values[static_cast<std::size_t>((box.y0 + y) * 100 + box.x0 + x)])
              << how.at(1) << x << " " << y;
        }
      }
    }
  }
}

TEST_F(Panels, HaveTitlesAndRanges) {
  const Arguments titled = {"--set", "render.width=400",           "--set", "render.height=200",
                            "--set", "panel.0.field=displacement", "--set", "panel.1.field=von_mises"};
  expect(0, run("plain", titled));
  expect(0, run("titled", titled + Arguments{"--set", "panel.1.title=stress"}));
  const render::Pixels plain = picture(at("plain"), 1), with = picture(at("titled"), 1);
  EXPECT_EQ(part(plain, 0, 0, 200, 200), part(with, 0, 0, 200, 200));
  EXPECT_NE(part(plain, 202, 0, 198, 100), part(with, 202, 0, 198, 100));
  EXPECT_EQ(part(plain, 202, 100, 198, 100), part(with, 202, 100, 198, 100)) << "at the top";
  const auto ranges = run_json("plain").at("frames").at(1).at("ranges");
  EXPECT_TRUE(ranges.contains("panel.0/bar"));
  EXPECT_TRUE(ranges.contains("panel.1/bar"));
}

TEST(PanelPlaces, FillThePicture) {
  apps::SceneDesc scene;
  scene.render.width = 101;
  scene.render.height = 77;
  for (std::size_t count = 1; count < 12; ++count) {
    scene.panel.resize(count);
    const std::vector<apps::PanelPlace> places = apps::panel_places(scene);
    ASSERT_EQ(places.size(), count);
    int right = 0, bottom = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const apps::PanelPlace& p = places[i];
      EXPECT_GT(p.width, 0);
      EXPECT_GT(p.height, 0);
      right = std::max(right, p.x + p.width);
      bottom = std::max(bottom, p.y + p.height);
      if (i > 0 && places[i - 1].y == p.y) {
        EXPECT_EQ(places[i - 1].x + places[i - 1].width + 4, p.x);
      }
    }
    EXPECT_EQ(right, 101);
    EXPECT_EQ(bottom, 77);
  }
  scene.panel.resize(4);
  EXPECT_EQ(apps::panel_places(scene)[2].x, 0) << "two by two";
  scene.layout.columns = 4;
  EXPECT_EQ(apps::panel_places(scene)[3].y, 0) << "a row";
}

TEST_F(Panels, WhatIsWrongIsTold) {
  const auto said = [&](const Arguments& sets) { return expect(2, run("r", sets)); };
  EXPECT_NE(said({"--set", "panel.0.title=a", "--set", "panel.1.title=b", "--set", "render.width=30"})
                .find("panel.0: the picture of 30 x 48 leaves it 13 x 48 pixels; at least 16 are needed"),
            std::string::npos);
  EXPECT_NE(
      said({"--set", "panel.0.colormap=magma"}).find("panel.0 has a range or colormap, but shows no field"),
      std::string::npos);
  EXPECT_NE(said({"--set", "panel.0.title={nme}"}).find("panel.0.title: "), std::string::npos);
  EXPECT_NE(said({"--set", "panel.0.position=[0, 0.3, 0]"})
                .find("panel.0.position and panel.0.look_at are the same point"),
            std::string::npos);
}

}  // namespace panels_test
}  // namespace lagomorph::tests
