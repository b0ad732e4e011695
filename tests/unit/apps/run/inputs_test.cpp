#include "apps/run/inputs.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/scene/scene.h"
#include "tests/support/program.h"
#include "tests/support/run_tree.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace inputs_test {

namespace fs = std::filesystem;
using tests::read_all;

/// A scene with files of one name in two folders, a TetGen pair and a fine mesh. Files need only be there.
fs::path write_scene(const tests::TemporaryDirectory& dir) {
  dir.write("meshes/a/bar.msh", "first");
  dir.write("meshes/b/bar.msh", "second");
  dir.write("meshes/pair.node", "nodes");
  dir.write("meshes/pair.ele", "elements");
  dir.write("meshes/fine.obj", "fine");
  return dir.write("scenes/s.toml",
                   "[[body]]\nmesh = '../meshes/a/bar.msh'\nsurface.mesh = '../meshes/fine.obj'\n"
                   "[[body]]\nmesh = '../meshes/b/bar.msh'\n"
                   "[[body]]\nmesh = '../meshes/a/../a/bar.msh'\n"
                   "[[body]]\nmesh = '../meshes/pair.node'\n");
}

TEST(Inputs, EveryFileHasOneNameInTheRun) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path() / "run");
  const SceneDesc scene = self_contained(load_scene(write_scene(dir), {}), paths);
  ASSERT_EQ(scene.body.size(), 4U);
  EXPECT_EQ(scene.directory, paths.root());
  EXPECT_EQ(scene.body[0].surface.mesh, "inputs/fine.obj");
  EXPECT_EQ(scene.body[0].mesh, scene.body[2].mesh);
  EXPECT_NE(scene.body[0].mesh, scene.body[1].mesh);
  EXPECT_EQ(scene.body[3].mesh, "inputs/pair.node");
}

TEST(Inputs, TheRunHoldsWhatItNames) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path() / "run");
  const SceneDesc scene = load_scene(write_scene(dir), {});
  write_inputs(scene, paths);
  dir.write("run/inputs/old.msh", "of a scene before");
  write_inputs(scene, paths);
  EXPECT_EQ(tests::count_files(paths.inputs()), 5);
  EXPECT_EQ(read_all(paths.inputs() / "pair.ele"), "elements");
  fs::remove_all(dir.path() / "meshes");

  const SceneDesc again = load_scene(paths.scene(), {});
  EXPECT_EQ(read_all(again.directory / again.body[0].mesh), "first");
  EXPECT_EQ(read_all(again.directory / again.body[1].mesh), "second");
}

TEST(Inputs, ASceneThatStandsInTheRunIsTheSame) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path() / "run"), other(dir.path() / "other");
  write_inputs(load_scene(write_scene(dir), {}), paths);
  const auto before = tests::tree(paths.root());
  write_inputs(load_scene(paths.scene(), {}), paths);
  EXPECT_EQ(tests::tree(paths.root()), before);
  write_inputs(load_scene(paths.scene(), {}), other);
  tests::expect_same_run(paths.root(), other.root());
}

}  // namespace inputs_test
}  // namespace lagomorph::apps
