#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/scene/scene.h"

namespace lagomorph::apps {
namespace fuzz_test {

const char text[] = R"(# A scene with something of everything.
name = "all"
[time]
fps = 24
gravity = [0, -1.62, 0]
[solver]
tolerance = 1e-8
[[body]]
name = "a"
mesh = "a.msh"
material = { model = "neo_hookean", C = 1e5, D = 2e5 }
surface = { mesh = "fine.obj", smooth = true }
[[body.pin]]
vertices = [0, 1, 2]
box = [[0, 0, 0], [1, 1, 1]]
[[body.pin]]
sphere = { center = [0, 0, 0], radius = 1 }
plane = { point = [0, 0, 0], normal = [0, 1, 0] }
[[body]]
mesh = "b.msh"
[camera]
orthographic = 2.0
[render]
channels = ["depth"]
[render.raster]
multisample = 1
[[light]]
size = [1, 1]
[background]
color = [0.5, 0.5, 0.5]
)";

/// Either a scene, or one Error that is the input's fault and says where.
void expect_scene_or_error(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  try {
    parse_scene(scene, "a.toml", overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::wrong_input);
    const std::string what = error.what();
    EXPECT_TRUE(what.starts_with("a.toml:") || what.starts_with("--set ")) << what << "\nof\n" << scene;
  }
}

TEST(SceneFuzz, WholeIsValid) { EXPECT_EQ(parse_scene(text, "a.toml", {}).body.size(), 2U); }

TEST(SceneFuzz, CutAnywhere) {
  const std::string whole = text;
  for (std::size_t n = 0; n < whole.size(); ++n) expect_scene_or_error(whole.substr(0, n));
  for (std::size_t n = 0; n < whole.size(); ++n) expect_scene_or_error(whole.substr(n));
}

TEST(SceneFuzz, BytesChanged) {
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    std::string scene = text;
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < changes; ++k) {
      char& c = scene[random() % scene.size()];
      c = random() % 2 == 0 ? static_cast<char>(random() % 256) : "[]{}\"'=.,\n-#0e"[random() % 14];
    }
    expect_scene_or_error(scene);
  }
}

TEST(SceneFuzz, LinesExchanged) {
  std::vector<std::string> lines(1);
  for (const char* c = text; *c != '\0'; ++c) {
    lines.back() += *c;
    if (*c == '\n') lines.emplace_back();
  }
  std::mt19937 random(4);
  for (int i = 0; i < 2000; ++i) {
    std::string scene;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (random() % 10 != 0) scene += lines[random() % 8 == 0 ? random() % lines.size() : k];
    }
    expect_scene_or_error(scene);
  }
}

TEST(SceneFuzz, Overrides) {
  const std::vector<std::string> keys = {
      "name", "time",    "body",     "0",  "1",     "2",      "7",   "99999999999999999999",
      "pin",  "density", "material", "mu", "light", "camera", "fov", "box",
      "",     "-1",      "x"};
  const std::vector<std::string> values = {"1",
                                           "-1",
                                           "nan",
                                           "[]",
                                           "{}",
                                           "[1,2,3]",
                                           "[[1]]",
                                           "'a'",
                                           "a b",
                                           "",
                                           "{mu=1,lambda=2}",
                                           "[{mesh='a'}]",
                                           "1979-05-27",
                                           "\"",
                                           "'''",
                                           "\n",
                                           "\x01",
                                           "\xFF",
                                           "1e400",
                                           "[[[[[[[[[[[[]]]]]]]]]]]]",
                                           "{a={b={c=1}}}"};
  std::mt19937 random(5);
  for (int i = 0; i < 5000; ++i) {
    std::vector<std::string> overrides(1 + random() % 3);
    for (std::string& o : overrides) {
      const std::size_t depth = 1 + random() % 5;
      for (std::size_t k = 0; k < depth; ++k) o += (k == 0 ? "" : ".") + keys[random() % keys.size()];
      o += "=" + values[random() % values.size()];
    }
    expect_scene_or_error(text, overrides);
  }
}

TEST(SceneFuzz, DeepNestingIsAnError) {
  for (const char* bracket : {"[", "{a="}) {
    std::string scene = "name = ";
    for (int i = 0; i < 100000; ++i) scene += bracket;
    expect_scene_or_error(scene);
    expect_scene_or_error("", {"name=" + scene.substr(7)});
  }
  std::string path = "a";
  for (int i = 0; i < 100000; ++i) path += ".a";
  expect_scene_or_error("", {path + "=1"});
  expect_scene_or_error("", {"name={" + path + "=1}"});
  expect_scene_or_error(path + " = 1");
  expect_scene_or_error("[" + path + "]");
}

}  // namespace fuzz_test
}  // namespace lagomorph::apps
