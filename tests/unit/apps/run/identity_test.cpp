#include "apps/run/identity.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/scene/scene.h"
#include "tests/support/run_tree.h"
#include "tests/unit/apps/run/run_fixture.h"

namespace lagomorph::apps {
namespace identity_test {

TEST(Identity, HashesFollowTheKeys) {
  const Identity a = some_identity();
  EXPECT_EQ(a.simulation_hash(), some_identity().simulation_hash());
  EXPECT_EQ(a.picture_hash(), some_identity().picture_hash());
  const Identity denser = some_identity("999.0"), closer = some_identity("1000.0", "20.0"),
                 rebuilt = some_identity("1000.0", "35.0", "\"b\"");
  EXPECT_NE(a.simulation_hash(), denser.simulation_hash());
  EXPECT_NE(a.picture_hash(), denser.picture_hash());
  EXPECT_NE(a.state_maker(), denser.state_maker());
  EXPECT_EQ(a.simulation_hash(), closer.simulation_hash());
  EXPECT_EQ(a.state_maker(), closer.state_maker());
  EXPECT_NE(a.picture_hash(), closer.picture_hash());
  EXPECT_EQ(a.simulation_hash(), rebuilt.simulation_hash());
  EXPECT_NE(a.state_maker(), rebuilt.state_maker());
  EXPECT_NE(a.picture_hash(), rebuilt.picture_hash());
}

TEST(Identity, DifferencesNameTheKeys) {
  using Texts = std::vector<std::string>;
  const Identity a = some_identity();
  EXPECT_EQ(differences(a, a, true), Texts{});
  EXPECT_EQ(differences(a, some_identity("999.0", "20.0", "\"b\""), true),
            (Texts{"body.0.density 1000.0 -> 999.0", "camera.fov 35.0 -> 20.0",
                   "build.simulation \"a\" -> \"b\"", "build.program \"a\" -> \"b\""}));
  EXPECT_EQ(differences(a, some_identity("999.0", "20.0"), false), Texts{"body.0.density 1000.0 -> 999.0"});
  const Identity fewer({{"time.fps", "30.0"}}, a.picture(), a.simulation_build(), a.picture_build());
  EXPECT_EQ(differences(a, fewer, true), Texts{"body.0.density 1000.0 -> default"});
  EXPECT_EQ(differences(fewer, a, true), Texts{"body.0.density default -> 1000.0"});
  EXPECT_EQ(differences(a, some_identity(std::string(100, '1')), false),
            Texts{"body.0.density 1000.0 -> " + std::string(45, '1') + "..."});
}

TEST(Identity, OfASceneKnowsWhatStatesAndPicturesDependOn) {
  const std::string file = tests::data_file("run/bar.toml");
  const auto identity = [&](const std::vector<std::string>& overrides, const std::string& renderer = "r") {
    return make_identity(load_scene(file, overrides), renderer);
  };
  const Identity a = identity({});
  for (const char* same : {"name=other", "time.frames=7"}) {
    EXPECT_EQ(a.picture_hash(), identity({same}).picture_hash()) << same;
    EXPECT_EQ(a.state_maker(), identity({same}).state_maker()) << same;
  }
  for (const char* physics : {"body.0.density=5", "time.fps=24", "time.substeps=2", "solver.tolerance=1e-5",
                              "body.0.pin.0.top=0.2", "body.0.scale=2", "body.0.material.poisson=0.2"}) {
    EXPECT_NE(a.simulation_hash(), identity({physics}).simulation_hash()) << physics;
    EXPECT_NE(a.picture_hash(), identity({physics}).picture_hash()) << physics;
  }
  for (const char* look : {"camera.fov=20", "render.width=32", "render.backend=path", "sky.strength=2",
                           "ground.radius=20", "body.0.look.roughness=0.1", "body.0.surface.mesh=''"}) {
    EXPECT_EQ(a.simulation_hash(), identity({look}).simulation_hash()) << look;
    EXPECT_NE(a.picture_hash(), identity({look}).picture_hash()) << look;
  }
  EXPECT_NE(a.picture_hash(), identity({}, "another build").picture_hash());
  EXPECT_EQ(a.state_maker(), identity({}, "another build").state_maker());
}

}  // namespace identity_test
}  // namespace lagomorph::apps
