#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/scene/scene.h"

namespace lagomorph::apps {
namespace set_test {

const std::string text = R"(
[time]
gravity = [0, -9.81, 0]
[[body]]
mesh = "a.msh"
material = { young = 1e6, poisson = 0.3 }
[[body.pin]]
top = 0.1
[[body]]
mesh = "b.msh"
)";

SceneDesc with(const std::vector<std::string>& overrides) { return parse_scene(text, "a.toml", overrides); }

TEST(Set, TakesATomlValueOrAString) {
  EXPECT_EQ(with({"time.fps=24"}).time.fps, 24.0);
  EXPECT_EQ(with({"time.fps = 1.5e1"}).time.fps, 15.0);
  EXPECT_EQ(with({"time.integrator=linearly_implicit_euler"}).time.integrator, "linearly_implicit_euler");
  EXPECT_EQ(with({"time.integrator=\"linearly_implicit_euler\""}).time.integrator, "linearly_implicit_euler");
  EXPECT_EQ(with({"body.0.mesh=../it's a mesh.msh"}).body[0].mesh, "../it's a mesh.msh");
  EXPECT_EQ(with({"name=a=b"}).name, "a=b");
  EXPECT_EQ(with({"time.gravity=[0, 0, -1]"}).time.gravity, sim::Vec3(0, 0, -1));
  EXPECT_FALSE(with({"ground.enabled=false"}).ground.enabled);
}

TEST(Set, ReachesIntoArrays) {
  const SceneDesc scene =
      with({"body.1.density=500", "body.0.pin.0.top=0.2", "body.0.pin.1.bottom=0.3", "time.gravity.1=-1.62"});
  EXPECT_EQ(scene.body[0].physics.density, 1000.0);
  EXPECT_EQ(scene.body[1].physics.density, 500.0);
  ASSERT_EQ(scene.body[0].physics.pin.size(), 2U);
  EXPECT_EQ(scene.body[0].physics.pin[0].top, 0.2);
  EXPECT_EQ(scene.body[0].physics.pin[1].bottom, 0.3);
  EXPECT_EQ(scene.time.gravity, sim::Vec3(0, -1.62, 0));
}

TEST(Set, TakesAwayWhatIsSetToNothing) {
  EXPECT_EQ(with({"time.gravity="}).time.gravity, SceneDesc{}.time.gravity);
  EXPECT_EQ(with({"time.fps=24", "time.fps= "}).time.fps, SceneDesc{}.time.fps);
  EXPECT_TRUE(with({"body.0.pin="}).body[0].physics.pin.empty());
  const SceneDesc one = with({"body.0="});
  ASSERT_EQ(one.body.size(), 1U);
  EXPECT_EQ(one.body[0].mesh, "b.msh");
  EXPECT_FALSE(with({"clip.normal=[1, 0, 0]", "clip="}).clip.has_value());
  for (const std::string wrong : {"clip=", "time.fbs=", "body.7=", "body.2="}) {
    try {
      with({wrong});
      FAIL() << wrong;
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).find("--set " + wrong + ": "), 0U) << e.what();
      EXPECT_EQ(e.status, ExitStatus::wrong_input) << e.what();
    }
  }
}

TEST(Set, MakesTablesThatAreNotThere) {
  const SceneDesc scene = with({"camera.orthographic=2", "light.0.radiance=3", "body.2.mesh=c.msh",
                                "body.1.pin.0.sphere.center=[1, 2, 3]", "body.1.pin.0.sphere.radius=4"});
  EXPECT_EQ(scene.camera.orthographic, 2.0F);
  ASSERT_EQ(scene.light.size(), 1U);
  EXPECT_EQ(scene.light[0].radiance, 3.0F);
  ASSERT_EQ(scene.body.size(), 3U);
  EXPECT_EQ(scene.body[2].mesh, "c.msh");
  EXPECT_EQ(scene.body[2].physics.name, "body2");
  ASSERT_TRUE(scene.body[1].physics.pin.at(0).sphere.has_value());
  EXPECT_EQ(scene.body[1].physics.pin[0].sphere->center, sim::Vec3(1, 2, 3));
  EXPECT_EQ(scene.body[1].physics.pin[0].sphere->radius, 4.0);
}

TEST(Set, TheLastWinsAndATableReplaces) {
  EXPECT_EQ(with({"time.fps=24", "time.fps=25"}).time.fps, 25.0);
  const SceneDesc scene = with({"body.0.material={ mu = 2, lambda = 3 }", "body.0.material.mu=4"});
  EXPECT_EQ(scene.body[0].physics.material.mu, 4.0);
  EXPECT_EQ(scene.body[0].physics.material.lambda, 3.0);
  EXPECT_FALSE(scene.body[0].physics.material.young.has_value());
}

TEST(Defaults, AreFilledIn) {
  const SceneDesc scene = parse_scene(text, "scenes/two.toml", {});
  EXPECT_EQ(scene.name, "two");
  EXPECT_EQ(scene.body[0].physics.name, "body0");
  EXPECT_EQ(scene.body[1].physics.name, "body1");
  EXPECT_EQ(scene.body[1].physics.material.young, 1e5);
  EXPECT_EQ(scene.body[1].physics.material.poisson, 0.3);
  EXPECT_EQ(scene.light.size(), 1U);
  EXPECT_EQ(scene.directory.filename(), "scenes");
  EXPECT_TRUE(scene.directory.is_absolute());
  EXPECT_EQ(with({"light=[]"}).light.size(), 0U);
  EXPECT_EQ(with({"body.1.material.young=7"}).body[1].physics.material.poisson, 0.3);
}

TEST(Scene, ReadsEveryPinSelector) {
  const SceneDesc scene = parse_scene(R"(
[[body]]
mesh = "a.msh"
[[body.pin]]
vertices = [0, 4, 7]
box = [[0, 0, 0], [1, 2.5, 3]]
sphere = { center = [1, 2, 3], radius = 0.5 }
plane = { point = [0, 1, 0], normal = [0, 2, 0] }
top = 0.1
bottom = 1
)",
                                      "a.toml", {});
  const sim::PinSettings& pin = scene.body.at(0).physics.pin.at(0);
  EXPECT_EQ(pin.vertices, (std::vector<int>{0, 4, 7}));
  ASSERT_TRUE(pin.box && pin.sphere && pin.plane);
  EXPECT_EQ(pin.box->min, sim::Vec3(0, 0, 0));
  EXPECT_EQ(pin.box->max, sim::Vec3(1, 2.5, 3));
  EXPECT_EQ(pin.sphere->center, sim::Vec3(1, 2, 3));
  EXPECT_EQ(pin.sphere->radius, 0.5);
  EXPECT_EQ(pin.plane->point, sim::Vec3(0, 1, 0));
  EXPECT_EQ(pin.plane->normal, sim::Vec3(0, 2, 0));
  EXPECT_EQ(pin.top, 0.1);
  EXPECT_EQ(pin.bottom, 1.0);
}

/// What is found late, over all frames, is told where it was given, though the file gives the camera too.
TEST(Set, WrongCamerasAreToldWithTheirOverride) {
  const std::string file =
      "[camera]\nposition = [0, 1, 3]\nlook_at = [0, 1, 0]\nup = [0, 1, 0]\n"
      "[[camera.key]]\nframe = 0\nfov = 30\n[[body]]\nmesh = \"a.msh\"";
  const auto told = [&](const std::string& override_text) {
    try {
      parse_scene(file, "RUN/scene.toml", std::vector<std::string>{override_text});
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  for (const std::string set :
       {"camera.key=[{ frame = 0, position = [0, 0, 3] }, { frame = 4, position = [0, 2, -3] }]",
        "camera.key=[{ frame = 9, look_at = [0, 1, 3] }]", "camera.key.0.position=[0, 1, 0]",
        "camera.look_at=[0, 1, 3]", "camera.up=[0, 0, 1]", "camera.key=[{ frame = 3 }]",
        "camera.key.0.up=[0, 0, 2]"}) {
    const std::string line = told(set);
    EXPECT_TRUE(line.starts_with("--set " + set + ": ")) << line;
  }
}

}  // namespace set_test
}  // namespace lagomorph::apps
