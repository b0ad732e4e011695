#include "apps/pipeline/overlays.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/npy.h"
#include "apps/pipeline/build_scene.h"
#include "apps/scene/scene.h"
#include "tests/support/pictures.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// Overlays of the small bar.
namespace lagomorph::apps {
namespace overlays_test {

using tests::Arguments;
using tests::operator+;

struct Bar {
  explicit Bar(const std::vector<std::string>& overrides)
      : scene(load_scene(tests::data_file("run/bar.toml"), overrides)),
        model(build_model(scene, quiet)),
        surfaces(drawn_surfaces(scene, model, quiet)),
        overlays(scene, model, surfaces) {}

  /// Over white.
  render::Picture picture(int width = 160, int height = 120) const {
    render::Picture drawn{width, height, {}};
    drawn.rgb.assign(static_cast<std::size_t>(3 * width * height), 255);
    overlays.draw(drawn, render::Camera(scene.camera, width, height), model.initial_state());
    return drawn;
  }
  int pixels() const {
    const render::Picture drawn = picture();
    return static_cast<int>(
        std::count_if(drawn.rgb.begin(), drawn.rgb.end(), [](std::uint8_t v) { return v < 250; }));
  }

  Progress quiet{true};
  SceneDesc scene;
  sim::Model model;
  std::vector<sim::Surface> surfaces;
  Overlays overlays;
};

TEST(Overlays, NoneByDefault) {
  EXPECT_EQ(Bar({}).pixels(), 0);
  EXPECT_TRUE(Bar({}).overlays.remarks().empty());
}

TEST(Overlays, WireframesOfSurfaceAndTets) {
  const int fine = Bar({"body.0.wireframe.show=true"}).pixels();
  const int tets = Bar({"body.0.wireframe={ show = true, of = 'tets' }"}).pixels();
  EXPECT_GT(fine, 300);
  EXPECT_GT(tets, 300);
  EXPECT_NE(fine, tets);
  EXPECT_GT(Bar({"body.0.wireframe={ show = true, of = 'tets', hidden = 'all' }"}).pixels(), 1.2 * tets);
  // Its own tets hide what is behind them whether it is filled or not.
  EXPECT_EQ(Bar({"body.0.wireframe={ show = true, of = 'tets' }", "body.0.surface.fill=false"}).pixels(),
            tets);
}

/// Lines behind a see-through surface show as much as it lets through, its own back ones among them. A clear
/// body bends light: it hides as a solid one does.
TEST(Overlays, WhatIsBehindASeeThroughBodyShowsThrough) {
  const char* const lines = "body.0.wireframe.show=true";
  const render::Picture solid = Bar({lines}).picture(),
                        all = Bar({lines, "body.0.wireframe.hidden=all"}).picture(),
                        through = Bar({lines, "body.0.look.opacity=0.25"}).picture(),
                        clear = Bar({lines, "body.0.look.transmission=1"}).picture();
  EXPECT_EQ(clear.rgb, solid.rgb);
  int behind = 0;
  for (std::size_t i = 0; i < solid.rgb.size(); ++i) {
    if (all.rgb[i] == solid.rgb[i]) {
      ASSERT_EQ(through.rgb[i], solid.rgb[i]);
      continue;
    }
    ASSERT_LE(through.rgb[i], solid.rgb[i]) << "lines are dark";
    // Where a line leaves the body's outline by half its width, nothing lets it through.
    if (through.rgb[i] == solid.rgb[i]) continue;
    ASSERT_NEAR(through.rgb[i], 0.25 * solid.rgb[i] + 0.75 * all.rgb[i], 2.0);
    ++behind;
  }
  EXPECT_GT(behind, 500);
  // Signs, too: half as much as they are seen over half a body.
  const auto pins = [](const char* more) {
    return Bar({"glyphs.pins=true", "body.0.pin.0.top=1", more}).pixels();
  };
  EXPECT_GT(pins("body.0.look.opacity=0.25"), pins("body.0.look.opacity=1.0"));
}

/// The lines between the four triangles that a quadratic face is drawn by are none of its edges.
TEST(Overlays, QuadraticTetsHaveTheLinesOfLinearOnes) {
  const Bar linear({"body.0.wireframe={ show = true, of = 'tets' }"}),
      quadratic({"body.0.wireframe={ show = true, of = 'tets' }", "body.0.element=quadratic"});
  const render::Picture a = linear.picture(), b = quadratic.picture();
  int differ = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) differ += std::abs(a.rgb[i] - b.rgb[i]) > 40 ? 1 : 0;
  EXPECT_LT(differ, 30);  // of some thousand
}

TEST(Overlays, ABodyWithoutFillIsNotDrawn) {
  const Bar bar({"body.0.surface.fill=false"});
  EXPECT_TRUE(build_render_scene(bar.scene, bar.model, bar.surfaces).meshes.at(0).triangles.empty());
  ASSERT_EQ(bar.overlays.remarks().size(), 1U);
  EXPECT_NE(bar.overlays.remarks()[0].find("the surface of 'bar' is not drawn"), std::string::npos);
}

/// Of a body that is opened, too.
TEST(Overlays, TheGhostIsWholeAtRest) {
  const std::vector<std::string> ghost = {"body.0.ghost={ show = 'outline', over = true }",
                                          "body.0.surface.mesh=''"};
  const Bar whole(ghost), cut({ghost[0], ghost[1], "clip={ point = [0, 0.3, 0], normal = [0, 1, 0] }"});
  EXPECT_GT(whole.pixels(), 100);
  EXPECT_EQ(whole.picture().rgb, cut.picture().rgb);
}

TEST(Overlays, WhatHasNoEffectIsTold) {
  const Bar unseen({"body.0.surface.fill=false", "body.0.wireframe.show=true", "body.0.look.field=J"});
  ASSERT_EQ(unseen.overlays.remarks().size(), 1U);
  EXPECT_EQ(unseen.overlays.remarks()[0],
            "body.0.look.field has no effect: the surface of 'bar' is not drawn");
  const Bar cut(
      {"clip={ point = [0, 0.3, 0], normal = [0, 1, 0], color = [1, 0, 0] }", "body.0.look.field=J"});
  ASSERT_EQ(cut.overlays.remarks().size(), 1U);
  EXPECT_EQ(cut.overlays.remarks()[0], "clip.color has no effect: the bodies' fields colour the cut");
}

TEST(Overlays, AFlippedSurfaceIsInsideOut) {
  const Bar bar({}), flipped({"body.0.surface.flip=true"});
  const auto a = build_render_scene(bar.scene, bar.model, bar.surfaces).meshes.at(0).triangles.at(3);
  const auto b =
      build_render_scene(flipped.scene, flipped.model, flipped.surfaces).meshes.at(0).triangles.at(3);
  EXPECT_EQ(a[0], b[0]);
  EXPECT_EQ(a[1], b[2]);
  EXPECT_EQ(a[2], b[1]);
}

/// The sum of red less that of blue: over white, what is not tinted has none.
int redness(const render::Picture& p) {
  int sum = 0;
  for (std::size_t i = 0; i < p.rgb.size(); i += 3) sum += p.rgb[i] - p.rgb[i + 2];
  return sum;
}

TEST(Overlays, FaceOrientationTellsOutsideFromInside) {
  const char* const on = "body.0.surface.face_orientation=true";
  const int outside = redness(Bar({on}).picture()),
            flipped = redness(Bar({on, "body.0.surface.flip=true"}).picture());
  EXPECT_LT(outside, -10000);
  EXPECT_NEAR(flipped, -outside, -0.02 * outside) << "the colours are each other's mirror";
  EXPECT_EQ(redness(Bar({"body.0.surface.flip=true"}).picture()), 0);
  const Bar unseen({on, "body.0.surface.fill=false", "body.0.wireframe.show=true"});
  ASSERT_EQ(unseen.overlays.remarks().size(), 1U);
  EXPECT_EQ(unseen.overlays.remarks()[0],
            "body.0.surface.face_orientation has no effect: the surface of 'bar' is not drawn");
}

/// A closed surface of opacity 1/2 shows half of its outside and a quarter of the inside of its back.
TEST(Overlays, FaceOrientationIsSeenAsMuchAsTheSurfaceIsOpaque) {
  const char* const on = "body.0.surface.face_orientation=true";
  const std::vector<std::string> half = {on, "body.0.look.opacity=0.5"};
  const auto middle = [](const render::Picture& p) {  // of the bar
    const std::size_t at =
        3 * (static_cast<std::size_t>(p.height / 2 + 10) * static_cast<std::size_t>(p.width) +
             static_cast<std::size_t>(p.width / 2));
    return std::array<int, 3>{p.rgb[at], p.rgb[at + 1], p.rgb[at + 2]};
  };
  EXPECT_EQ(middle(Bar({on}).picture()), (std::array{40, 90, 255})) << "over white";
  // 1/4 white, 1/2 blue, 1/4 red, but for rounding.
  const std::array<int, 3> seen = middle(Bar(half).picture());
  const std::array<double, 3> expected = {0.25 * 255 + 0.5 * 40 + 0.25 * 255,
                                          0.25 * 255 + 0.5 * 90 + 0.25 * 40,
                                          0.25 * 255 + 0.5 * 255 + 0.25 * 40};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 1.5) << c;
  // Behind another see-through body that does not tell its own: a quarter of what it is alone.
  const std::string front = "body.1={ name = 'front', mesh = '" + tests::data_file("run/bar.msh").string() +
                            "', translate = [0, 0, 0.5], look = { opacity = 0.5 } }";
  const std::array<int, 3> behind = middle(Bar({on, front}).picture());
  const std::array<double, 3> through = {255 + 0.25 * (40 - 255), 255 + 0.25 * (90 - 255), 255};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(behind[c], through[c], 1.5) << c;
}

TEST(Overlays, AClipLeavesWholeTetsAndColorsTheCut) {
  const Bar whole({"body.0.surface.mesh=''"});
  const Bar cut({"clip={ point = [0, 0.3, 0], normal = [0, -1, 0], color = [1, 0.5, 0] }"});
  EXPECT_LT(cut.surfaces[0].triangles().size(), whole.surfaces[0].triangles().size());
  const auto drawn = build_render_scene(cut.scene, cut.model, cut.surfaces);
  const render::Mesh& mesh = drawn.meshes.at(0);
  const auto first = static_cast<std::size_t>(cut.surfaces[0].first_cut_vertex());
  ASSERT_LT(first, mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(mesh.colors[v].y(), v < first ? mesh.material.base_color.y() : 0.5F);
    if (v >= first) {
      EXPECT_NEAR(mesh.positions[v].y(), 0.3, 0.07);
    }
  }
  EXPECT_TRUE(build_render_scene(whole.scene, whole.model, whole.surfaces).meshes.at(0).colors.empty());
  EXPECT_LT(Bar({"clip={ point = [0, 0.3, 0], normal = [0, -1, 0] }", "body.0.wireframe.show=true"}).pixels(),
            0.8 * Bar({"body.0.wireframe={ show = true, of = 'tets' }"}).pixels());
}

TEST(Overlays, AClipThatLeavesNothingIsTold) {
  try {
    Bar({"clip={ point = [0, -9, 0], normal = [0, -1, 0] }"});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status, ExitStatus::wrong_input);
    EXPECT_STREQ(e.what(),
                 "clip leaves nothing: no tet of any body is on the side that clip.normal points to");
  }
}

class OverlayRuns : public tests::ProgramRun {
protected:
  /// Pixels of exactly the lines' colour.
  std::vector<bool> lines(const std::string& run, const std::string& frame) const {
    const render::Pixels picture = render::read_png(tests::read_all(at(run) / "frames" / frame), frame);
    const std::vector<std::uint8_t>& rgb = render::tests::bytes_of(picture);
    std::vector<bool> all;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
      all.push_back(rgb[i] == 255 && rgb[i + 1] == 0 && rgb[i + 2] == 255);
    return all;
  }
};

TEST_F(OverlayRuns, BothBackEndsHaveTheSameLines) {
  const Arguments with = {"--set", "body.0.wireframe={ show = true, color = [1, 0, 1], width = 3 }", "--set",
                          "render.channels=[]"};
  for (const char* const backend : {"raster", "path"}) {
    backend_ = backend;
    expect(0, run(backend, with + Arguments{"--set", "time.frames=2"}));
    EXPECT_FALSE(std::filesystem::exists(at(backend) / "aov"));
  }
  const std::vector<bool> raster = lines("raster", "frame_0001.png");
  EXPECT_GT(std::count(raster.begin(), raster.end(), true), 50);
  EXPECT_EQ(raster, lines("path", "frame_0001.png"));
}

TEST_F(OverlayRuns, ABodyOfLinesAloneAndACutOneAreDrawnByBoth) {
  const Arguments cut = {"--set", "clip={ point = [0, 0.3, 0], normal = [0, -1, 0] }",
                         "--set", "time.frames=2",
                         "--set", "body.0.look.field=von_mises"};
  const Arguments empty = {"--set", "body.0.surface.fill=false", "--set", "time.frames=2"};
  for (const char* const backend : {"raster", "path"}) {
    backend_ = backend;
    expect(0, run(std::string(backend) + "_cut", cut));
    expect(0, run(std::string(backend) + "_empty", empty));
  }
  // The same states as without the cut.
  expect(0, simulate("plain", {"--set", "time.frames=2"}));
  EXPECT_EQ(tests::read_all(at("raster_cut") / "states/frame_0001.npy"),
            tests::read_all(at("plain") / "states/frame_0001.npy"));
}

/// The wireframe of a subdivided surface is of as many lines as that of the coarse one; its ghost has all
/// edges, so that its outline is found.
TEST(Overlays, ASubdividedSurfaceHasTheCoarseLines) {
  const std::vector<std::string> tets = {"body.0.surface.mesh=''"},
                                 smooth = tets + std::vector<std::string>{"body.0.surface.subdivide=2"};
  const Bar coarse(tets), fine(smooth);
  const BodyLines before = lines_of(coarse.scene, coarse.model, coarse.surfaces, 0, "surface"),
                  after = lines_of(fine.scene, fine.model, fine.surfaces, 0, "surface");
  EXPECT_EQ(after.mesh.edges.size(), 4 * before.mesh.edges.size());
  EXPECT_EQ(after.mesh.triangles.size(), 16 * before.mesh.triangles.size());
  EXPECT_EQ(lines_of_surface(fine.surfaces[0]).mesh.edges.size(), 16 * before.mesh.edges.size());
  // Not the lines between the four triangles that a quadratic face is drawn by.
  const Bar quadratic(smooth + std::vector<std::string>{"body.0.element=quadratic"});
  EXPECT_EQ(lines_of(quadratic.scene, quadratic.model, quadratic.surfaces, 0, "surface").mesh.edges.size(),
            4 * lines_of_all_tets(quadratic.model, 0).mesh.edges.size());
  const std::string wire = "body.0.wireframe.show=true";
  const int straight = Bar(tets + std::vector<std::string>{wire}).pixels(),
            curved = Bar(smooth + std::vector<std::string>{wire}).pixels();
  EXPECT_NEAR(curved, straight, 0.25 * straight);
  const Bar cut(smooth + std::vector<std::string>{"clip={ point = [0, 0.3, 0], normal = [0, 1, 0] }"});
  ASSERT_EQ(cut.overlays.remarks().size(), 1U);
  EXPECT_EQ(cut.overlays.remarks()[0], "body.0.surface.subdivide has no effect: clip shows the tets");
}

/// Both back ends see the same fine triangles, and motion blur and vectors know where they were.
TEST_F(OverlayRuns, BothBackEndsDrawTheSmoothSurface) {
  const Arguments with = {"--set", "body.0.surface={ mesh = '', subdivide = 2 }",  "--set", "time.frames=2",
                          "--set", "render.channels=[\"triangle_id\", \"motion\"]"};
  std::map<std::string, std::vector<float>> ids, motion;
  for (const char* const backend : {"raster", "path"}) {
    backend_ = backend;
    expect(0, run(backend, with));
    const auto read = [&](const char* channel) {
      const auto file = at(backend) / "aov" / channel / "frame_0001.npy";
      return read_npy_floats(tests::read_all(file), file.string()).values;
    };
    ids[backend] = read("triangle_id");
    motion[backend] = read("motion");
  }
  int seen = 0, differ = 0;
  for (std::size_t i = 0; i < ids["path"].size(); ++i) {
    seen += ids["path"][i] >= 0.0F ? 1 : 0;
    if (ids["path"][i] != ids["raster"][i]) {
      ++differ;
      continue;
    }
    EXPECT_NEAR(motion["path"][2 * i + 1], motion["raster"][2 * i + 1], 0.01F);
  }
  EXPECT_GT(seen, 100);
  EXPECT_LE(differ, seen / 50);
  EXPECT_GT(*std::max_element(ids["path"].begin(), ids["path"].end()), 200.0F);
}

}  // namespace overlays_test
}  // namespace lagomorph::apps
