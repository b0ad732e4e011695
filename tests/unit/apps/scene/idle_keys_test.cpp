#include "apps/scene/idle_keys.h"

#include <gtest/gtest.h>

#include "apps/scene/scene.h"

namespace lagomorph::apps {
namespace idle_keys_test {

using Lines = std::vector<std::string>;

Lines idle(const std::string& text) {
  return idle_keys(parse_scene(text + "\n[[body]]\nmesh = \"a.msh\"", "a.toml", {}));
}

TEST(IdleKeys, DefaultsAreNotTold) {
  EXPECT_EQ(idle(""), Lines{});
  EXPECT_EQ(idle("[render]\nsamples = 64\nbackend = \"raster\"\npath = { bounces = 4 }"), Lines{});
}

TEST(IdleKeys, OfTheOtherBackEnd) {
  const std::string keys =
      "[render]\nsamples = 8\npath = { bounces = 2, seed = 1 }\nraster = { multisample = 1 }\n";
  EXPECT_EQ(idle(keys), Lines{"render.samples, render.path.bounces, render.path.seed have no effect: "
                              "render.backend = \"raster\""});
  EXPECT_EQ(idle(keys + "backend = \"path\""),
            Lines{"render.raster.multisample has no effect: render.backend = \"path\""});
  EXPECT_EQ(idle("[render]\nbackend = \"path\"\npath = { min_samples = 4 }"),
            Lines{"render.path.min_samples has no effect: render.path.noise_threshold is 0"});
}

TEST(IdleKeys, OfTheCamera) {
  EXPECT_EQ(idle("[camera]\ninterpolation = \"linear\"\nmargin = 0.1"),
            (Lines{"camera.interpolation has no effect: there is no [[camera.key]]",
                   "camera.margin has no effect: camera.frame is neither \"rest\" nor \"motion\""}));
  EXPECT_EQ(idle("[camera]\ninterpolation = \"linear\"\nkey = [{ frame = 0, fov = 20 }]"), Lines{});
  EXPECT_EQ(idle("[camera]\nmargin = 0.1\nframe = \"motion\""), Lines{});
  EXPECT_EQ(idle("[camera]\nmargin = 0.1\n[[panel]]\n[[panel]]\nframe = \"rest\""), Lines{}) << "of a panel";
  EXPECT_EQ(idle("[camera]\nblades = 6\nfocus_distance = 2\n[render]\nbackend = \"path\""),
            Lines{"camera.focus_distance, camera.blades have no effect: camera.f_stop is 0"});
  EXPECT_EQ(idle("[camera]\nblades = 6\nsensor_height = 0.03"),
            Lines{"camera.sensor_height, camera.blades have no effect: camera.f_stop is 0"})
      << "by the rasterizer, too";
  EXPECT_EQ(idle("[camera]\nkey = [{ frame = 0, focus_distance = 2 }]"),
            Lines{"camera.key.0.focus_distance has no effect: camera.f_stop is 0"});
  EXPECT_EQ(idle("[camera]\nkey = [{ frame = 0, focus_distance = 2 }, { frame = 9, f_stop = 2 }]"), Lines{});
}

TEST(IdleKeys, OfALensWithoutPerspective) {
  const std::string lens = "[camera]\nf_stop = 2\nblades = 5\n";
  for (const char* back_end : {"path", "raster"}) {
    const std::string render = std::string("[render]\nbackend = \"") + back_end + "\"\n";
    EXPECT_EQ(idle(render + lens + "orthographic = 2"),
              Lines{"camera.f_stop, camera.blades have no effect: camera.orthographic is given"});
    EXPECT_EQ(idle(render + lens), Lines{});
  }
  EXPECT_EQ(idle(lens + "[[panel]]\northographic = 1\n[[panel]]"), Lines{}) << "one panel has a perspective";
}

TEST(IdleKeys, OfLooksWithoutAField) {
  const auto told = [](const std::string& look, const std::string& more = "") {
    return idle_keys(parse_scene(
        more + "[[body]]\nmesh = \"a.msh\"\nlook = " + look + "\n[[body]]\nmesh = \"b.msh\"", "a.toml", {}));
  };
  EXPECT_EQ(told("{ range = [0, 1], colormap = \"magma\", color_bar = false }"),
            Lines{"body.0.look.colormap, body.0.look.range, body.0.look.color_bar have no effect: "
                  "body.0.look.field is \"none\""});
  EXPECT_EQ(told("{ range = [0, 1], field = \"J\" }"), Lines{});
  EXPECT_EQ(told("{ color_bar = false }", "[[panel]]\nfield = \"J\"\n[[panel]]\n"), Lines{}) << "of a panel";
}

TEST(IdleKeys, OfGlyphsOfNothing) {
  EXPECT_EQ(idle("[glyphs]\npins = true"), Lines{"glyphs.pins has no effect: no body has a pin"});
  const std::string held = "[glyphs]\npins = true\n[[body]]\nmesh = \"a.msh\"\npin = [{ top = 0.1 }]";
  EXPECT_EQ(idle_keys(parse_scene(held, "a.toml", {})), Lines{});
}

TEST(IdleKeys, OfADiagramThatIsNotShown) {
  const std::string plot = "[energy_plot]\nplace = \"top\"\nrange = [0, 1]\n";
  EXPECT_EQ(idle(plot),
            Lines{"energy_plot.place, energy_plot.range have no effect: energy_plot.show is false"});
  EXPECT_EQ(idle(plot + "show = true"), Lines{});
}

TEST(IdleKeys, OfAShadowCatcherInOpaquePictures) {
  EXPECT_EQ(idle("[ground]\nshadow_catcher = true"),
            Lines{"ground.shadow_catcher has no effect: render.transparent is false"});
  EXPECT_EQ(idle("[ground]\nshadow_catcher = true\n[render]\ntransparent = true"), Lines{});
}

TEST(IdleKeys, OfPanels) {
  EXPECT_EQ(idle("[layout]\ncolumns = 2"), Lines{"layout.columns has no effect: there is no [[panel]]"});
  EXPECT_EQ(idle("[layout]\ncolumns = 2\n[[panel]]"), Lines{});
}

}  // namespace idle_keys_test
}  // namespace lagomorph::apps
