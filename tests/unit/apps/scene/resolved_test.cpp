#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/hash.h"
#include "apps/scene/scene.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace resolved_test {

std::string value_of(const std::vector<ResolvedKey>& keys, const std::string& key) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const ResolvedKey& k) { return k.key == key; });
  return found == keys.end() ? "no such key" : found->value;
}

/// Keys whose values differ, or that only one has.
std::vector<std::string> differences(const std::vector<ResolvedKey>& a, const std::vector<ResolvedKey>& b) {
  std::vector<std::string> different;
  for (const ResolvedKey& k : a) {
    if (value_of(b, k.key) != k.value) different.push_back(k.key);
  }
  for (const ResolvedKey& k : b) {
    if (value_of(a, k.key) == "no such key") different.push_back(k.key);
  }
  return different;
}

class Resolved : public testing::Test {
protected:
  Resolved() {
    directory.write("a.msh", "tets");
    directory.write("fine.obj", "triangles");
    scene_file = directory.write(
        "a.toml", "[[body]]\nmesh = 'a.msh'\nsurface.mesh = 'fine.obj'\n[[body.pin]]\ntop = 0.1\n");
  }
  SceneDesc load(const std::vector<std::string>& overrides = {}) const {
    return load_scene(scene_file, overrides);
  }

  tests::TemporaryDirectory directory;
  std::filesystem::path scene_file;
};

TEST_F(Resolved, EachKeyIsOfOnePart) {
  const SceneDesc scene = load({"time.fps=24", "time.frames=7", "name=other", "camera.fov=36",
                                "light.0.size=[2, 1]", "body.0.material.model=neo_hookean"});
  const std::vector<ResolvedKey> simulation = simulation_keys(scene);
  const std::vector<ResolvedKey> picture = picture_keys(scene);
  EXPECT_EQ(value_of(simulation, "time.fps"), "24.0");
  EXPECT_EQ(value_of(simulation, "body.0.pin.0.top"), "0.1");
  EXPECT_EQ(value_of(simulation, "body.0.pin"), "1 of them");
  EXPECT_EQ(value_of(simulation, "body.0.material.model"), "\"neo_hookean\"");
  EXPECT_EQ(value_of(picture, "camera.fov"), "36.0");
  EXPECT_EQ(value_of(picture, "light.0.size"), "[2.0, 1.0]");
  for (const char* key : {"name", "time.frames"}) {
    EXPECT_EQ(value_of(simulation, key), "no such key");
    EXPECT_EQ(value_of(picture, key), "no such key");
  }
  for (const ResolvedKey& k : simulation) EXPECT_EQ(value_of(picture, k.key), "no such key") << k.key;
}

TEST_F(Resolved, WhatIsAtItsDefaultDoesNotCount) {
  const SceneDesc scene = load();
  const SceneDesc written_out = parse_scene(scene_to_toml(scene), scene_file, {});
  EXPECT_TRUE(differences(simulation_keys(scene), simulation_keys(written_out)).empty());
  EXPECT_TRUE(differences(picture_keys(scene), picture_keys(written_out)).empty());
  EXPECT_EQ(value_of(simulation_keys(scene), "time.fps"), "no such key");
  EXPECT_EQ(value_of(picture_keys(scene), "light"), "no such key");
  EXPECT_EQ(value_of(picture_keys(load({"light=[]"})), "light"), "0 of them");
}

TEST_F(Resolved, AChangeShowsInItsPartAlone) {
  const SceneDesc scene = load();
  const auto changes = [&](const char* change) {
    const SceneDesc other = load({change});
    std::vector<std::string> all = differences(simulation_keys(scene), simulation_keys(other));
    const bool simulation = !all.empty();
    const std::vector<std::string> picture = differences(picture_keys(scene), picture_keys(other));
    all.insert(all.end(), picture.begin(), picture.end());
    return (simulation ? "simulation:" : "picture:") +
           (all.size() == 1 ? all[0] : std::to_string(all.size()));
  };
  EXPECT_EQ(changes("time.frames=7"), "picture:0");
  EXPECT_EQ(changes("name=other"), "picture:0");
  EXPECT_EQ(changes("time.substeps=2"), "simulation:time.substeps");
  EXPECT_EQ(changes("solver.tolerance=1e-7"), "simulation:solver.tolerance");
  EXPECT_EQ(changes("body.0.pin.0.top=0.2"), "simulation:body.0.pin.0.top");
  EXPECT_EQ(changes("camera.fov=36"), "picture:camera.fov");
  EXPECT_EQ(changes("body.0.look.roughness=0.1"), "picture:body.0.look.roughness");
  EXPECT_EQ(changes("body.0.surface.smooth=false"), "picture:body.0.surface.smooth");
  EXPECT_EQ(changes("background.color=[0, 0, 0]"), "picture:background.color");
  EXPECT_EQ(changes("light=[]"), "picture:light");
}

TEST_F(Resolved, FilesCountByTheirContents) {
  const SceneDesc scene = load();
  EXPECT_EQ(value_of(simulation_keys(scene), "body.0.mesh"), "sha256:" + sha256("tets"));
  EXPECT_EQ(value_of(picture_keys(scene), "body.0.surface.mesh"), "sha256:" + sha256("triangles"));
  directory.write("elsewhere/b.msh", "tets");
  const SceneDesc moved = load({"body.0.mesh=elsewhere/b.msh"});
  EXPECT_TRUE(differences(simulation_keys(scene), simulation_keys(moved)).empty());
  directory.write("a.msh", "other tets");
  EXPECT_EQ(differences(simulation_keys(moved), simulation_keys(scene)),
            std::vector<std::string>{"body.0.mesh"});
  std::filesystem::remove(directory.path() / "a.msh");
  EXPECT_THROW(simulation_keys(scene), Error);
}

TEST_F(Resolved, InputFilesAreListedOnceAndTetgensInPairs) {
  directory.write("c.node", "nodes");
  directory.write("c.ele", "elements");
  const SceneDesc scene = parse_scene(
      "[[body]]\nmesh = 'a.msh'\nsurface.mesh = 'fine.obj'\n[[body]]\nmesh = './a.msh'\n"
      "[[body]]\nmesh = 'c.ele'\n[[body]]\nmesh = 'c.node'\n",
      scene_file, {});
  std::vector<std::string> listed;
  for (const InputFile& file : input_files(scene)) {
    EXPECT_TRUE(file.path.is_absolute());
    listed.push_back(file.key + " " + file.path.lexically_relative(directory.path()).string());
  }
  EXPECT_EQ(listed, (std::vector<std::string>{"body.0.mesh a.msh", "body.0.surface.mesh fine.obj",
                                              "body.2.mesh c.node", "body.2.mesh c.ele"}));
  EXPECT_EQ(value_of(simulation_keys(scene), "body.2.mesh"),
            "sha256:" + sha256("nodes") + " sha256:" + sha256("elements"));
  EXPECT_EQ(value_of(simulation_keys(scene), "body.3.mesh"), value_of(simulation_keys(scene), "body.2.mesh"));
}

TEST_F(Resolved, FilesThatAreNotThereAreToldWithTheirPlace) {
  const auto error_of = [&](const std::string& mesh) -> std::string {
    const auto file = directory.write("b.toml", "[[body]]\nmesh = '" + mesh + "'\n");
    try {
      load_scene(file, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.status, ExitStatus::wrong_input);
      return std::string(error.what()).substr(file.string().size());
    }
    return "no error";
  };
  EXPECT_EQ(error_of("b.msh"), ":2:8: body.0.mesh = 'b.msh': there is no such file");
  EXPECT_EQ(error_of("b.stp").substr(0, 66),
            ":2:8: body.0.mesh = 'b.stp' has an unknown extension; known are .m");
  std::filesystem::create_directory(directory.path() / "folder.msh");
  EXPECT_EQ(error_of("folder.msh"), ":2:8: body.0.mesh = 'folder.msh' is not a file");
  EXPECT_EQ(error_of("b.node"), ":2:8: body.0.mesh = 'b.node': there is no such file");
  directory.write("b.node", "");
  EXPECT_EQ(error_of("b.node"),
            ":2:8: body.0.mesh = 'b.node' needs 'b.ele' beside it: there is no such file");
}

TEST_F(Resolved, ASkyThatSetMakesAnotherHasItsUsualStrength) {
  EXPECT_EQ(load({"sky.model=physical"}).sky.strength, 5.0F);
  // A run's scene has every key written out.
  const auto run =
      directory.write("run.toml", "[[body]]\nmesh = 'a.msh'\n[sky]\nmodel = 'gradient'\nstrength = 0.6\n");
  EXPECT_EQ(load_scene(run, {}).sky.strength, 0.6F);
  EXPECT_EQ(load_scene(run, std::vector<std::string>{"sky.model=physical"}).sky.strength, 5.0F);
  EXPECT_EQ(load_scene(run, std::vector<std::string>{"sky.model=physical", "sky.strength=2"}).sky.strength,
            2.0F);
}

TEST_F(Resolved, FromBelowTheGroundIsLeftOut) {
  EXPECT_TRUE(load().ground.enabled);
  EXPECT_FALSE(load({"camera.view=bottom"}).ground.enabled);
  EXPECT_TRUE(load({"camera.view=bottom", "ground.enabled=true"}).ground.enabled);
}

}  // namespace resolved_test
}  // namespace lagomorph::apps
