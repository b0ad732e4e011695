#include "apps/scene/find_scene.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace find_scene_test {

TEST(AssetDirectory, OfAnInstalledProgram) {
  const tests::TemporaryDirectory directory;
  directory.write("prefix/share/lagomorph/scenes/bunny.toml", "");
  EXPECT_EQ(asset_directory(directory.path() / "prefix/bin"), directory.path() / "prefix/share/lagomorph");
}

TEST(AssetDirectory, OfABuildTree) {
  const tests::TemporaryDirectory directory;
  directory.write("assets/scenes/bunny.toml", "");
  EXPECT_EQ(asset_directory(directory.path() / "out/build/release"), directory.path() / "assets");
}

TEST(AssetDirectory, IsEmptyWhereThereIsNone) {
  const tests::TemporaryDirectory directory;
  EXPECT_EQ(asset_directory(directory.path() / "a/b/c/bin"), "");
}

TEST(FindScene, TakesAFileAsGiven) {
  const tests::TemporaryDirectory directory;
  const auto file = directory.write("bunny", "");
  EXPECT_EQ(find_scene(file), file);
  EXPECT_EQ(find_scene("/no/such/scene.toml"), "/no/such/scene.toml");
  EXPECT_EQ(find_scene("no_such_scene"), "no_such_scene");
}

}  // namespace find_scene_test
}  // namespace lagomorph::apps
