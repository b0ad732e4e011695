#include "apps/run/paths.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace paths_test {

TEST(RunPaths, AreThoseOfTheContract) {
  const RunPaths paths("out/x");
  EXPECT_EQ(paths.run_json(), "out/x/run.json");
  EXPECT_EQ(paths.scene(), "out/x/scene.toml");
  EXPECT_EQ(paths.energy(), "out/x/energy.csv");
  EXPECT_EQ(paths.mesh(), "out/x/mesh.msh");
  EXPECT_EQ(paths.state(0), "out/x/states/frame_0000.npy");
  EXPECT_EQ(paths.picture(12), "out/x/frames/frame_0012.png");
  EXPECT_EQ(paths.record(9999), "out/x/records/frame_9999.json");
  EXPECT_EQ(paths.picture(10000), "out/x/frames/frame_10000.png");
  EXPECT_EQ(paths.channel("depth", 3), "out/x/aov/depth/frame_0003.npy");
  EXPECT_EQ(paths.video("bunny"), "out/x/bunny.mp4");
}

TEST(RunPaths, FramesOfNames) {
  EXPECT_EQ(frame_of("a/frame_0012.png", ".png"), 12);
  EXPECT_EQ(frame_of("frame_123456.npy", ".npy"), 123456);
  for (const char* name :
       {"frame_0012.npy", "frame_12.png", "frame_00012.png", "frame_-001.png", "frame_001x.png",
        "x_frame_0012.png", ".frame_0012.png.7.tmp", "frame_.png", "frame_99999999999.png"}) {
    EXPECT_EQ(frame_of(name, ".png"), std::nullopt) << name;
  }
}

}  // namespace paths_test
}  // namespace lagomorph::apps
