#include "apps/pipeline/camera_rig.h"

#include <gtest/gtest.h>

#include "apps/pipeline/build_scene.h"
#include "apps/scene/scene.h"
#include "tests/support/run_tree.h"

namespace lagomorph::apps {
namespace camera_rig_test {

/// The small bar and a camera.
struct Rigged {
  explicit Rigged(const std::vector<std::string>& overrides)
      : scene(load_scene(tests::data_file("run/bar.toml"), overrides)),
        model(build_model(scene, quiet)),
        surfaces(build_surfaces(scene, model, quiet)),
        rig(scene, model, surfaces, 64, 48),
        X(model.initial_state().q) {}

  sim::VecX moved(const sim::Vec3& by) const { return X + by.replicate(X.size() / 3, 1); }

  Progress quiet{true};
  SceneDesc scene;
  sim::Model model;
  std::vector<sim::Surface> surfaces;
  CameraRig rig;
  sim::VecX X;
};

TEST(CameraRig, StandsStillByDefault) {
  const Rigged bar({});
  EXPECT_FALSE(bar.rig.needs_all_states());
  EXPECT_FALSE(bar.rig.fitted_box());
  EXPECT_EQ(bar.rig.settings(3, bar.moved({1, 2, 3})).position, bar.scene.camera.position);
}

TEST(CameraRig, FollowsTheCenterOfMass) {
  const Rigged bar({"camera.follow=center_of_mass"});
  EXPECT_EQ(bar.rig.settings(0, bar.X).position, bar.scene.camera.position);
  const render::CameraSettings c = bar.rig.settings(2, bar.moved({0.5, -2, 1}));
  EXPECT_LT((c.position - bar.scene.camera.position - render::Vec3(0.5F, -2, 1)).norm(), 1e-6F);
  EXPECT_LT((c.look_at - bar.scene.camera.look_at - render::Vec3(0.5F, -2, 1)).norm(), 1e-6F);
}

TEST(CameraRig, ABoxOfAllThatWasSeen) {
  Rigged bar({"camera.frame=motion", "body.0.surface.mesh=''"});
  EXPECT_TRUE(bar.rig.needs_all_states());
  const std::array<double, 6> first = bar.rig.fitted_box().value();
  bar.rig.see(bar.moved({3, 0, -1}));
  const std::array<double, 6> both = bar.rig.fitted_box().value();
  const std::array<double, 6> expected = {first[0],       first[1], first[2] - 1.0,
                                          first[3] + 3.0, first[4], first[5]};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(both[i], expected[i], 1e-12) << i;
  const Rigged fixed({"camera.frame=rest", "body.0.surface.mesh=''"});
  EXPECT_FALSE(fixed.rig.needs_all_states());
  EXPECT_EQ(fixed.rig.fitted_box(), first);
}

/// What is followed is fitted as it is seen: a body that only flies on needs no more room.
TEST(CameraRig, FollowsAndFits) {
  Rigged bar({"camera.frame=motion", "camera.follow=center_of_mass", "body.0.surface.mesh=''"});
  const std::array<double, 6> first = bar.rig.fitted_box().value();
  bar.rig.see(bar.moved({3, 0, -1}));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(bar.rig.fitted_box().value()[i], first[i], 1e-12) << i;
}

}  // namespace camera_rig_test
}  // namespace lagomorph::apps
