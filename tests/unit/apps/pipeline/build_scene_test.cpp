#include "apps/pipeline/build_scene.h"

#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/scene/scene.h"
#include "sim/error.h"
#include "tests/support/run_tree.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace {

SceneDesc bar_scene(const std::vector<std::string>& overrides = {}) {
  return load_scene(tests::data_file("run/bar.toml"), overrides);
}

/// Remembers what it is told to draw.
class ListeningRenderer final : public render::Renderer {
public:
  std::vector<std::vector<render::Vec3>> meshes;
  std::string_view name() const override { return "listening"; }
  void set_scene(const render::RenderScene& scene) override { meshes.resize(scene.meshes.size()); }
  void update_positions(int mesh, std::span<const render::Vec3> positions) override {
    meshes.at(static_cast<std::size_t>(mesh)).assign(positions.begin(), positions.end());
  }
  render::Image render(const render::Camera&, const render::FrameInfo&) override { return {}; }
  std::string description() const override { return ""; }
};

TEST(BuildScene, SurfacesAreTheBoundaryOrTheFineMesh) {
  Progress quiet(true);
  const SceneDesc fine = bar_scene(), coarse = bar_scene({"body.0.surface.mesh=''"});
  const sim::Model model = build_model(fine, quiet);
  EXPECT_EQ(model.mesh().vertex_count(), 63);
  EXPECT_EQ(build_surfaces(fine, model, quiet).at(0).vertex_count(), 58);
  EXPECT_EQ(build_surfaces(coarse, model, quiet).at(0).triangles().size(), 2U * (2 * 2 * 2 + 4 * 2 * 6));
}

TEST(BuildScene, TheFineMeshIsPlacedAsItsBody) {
  Progress quiet(true);
  const SceneDesc scene =
      bar_scene({"body.0.scale=2", "body.0.rotate=[0, 0, 90]", "body.0.translate=[1, 2, 3]"});
  const sim::Model model = build_model(scene, quiet);
  const auto drawn = build_render_scene(scene, model, build_surfaces(scene, model, quiet));
  // The prism's axis goes from y = 0.02 to 0.58; turned, it goes along -x.
  const std::vector<render::Vec3>& positions = drawn.meshes.at(0).positions;
  EXPECT_LT((positions.at(56) - render::Vec3(1.0F - 2 * 0.02F, 2.0F, 3.0F)).norm(), 1e-5F);
  EXPECT_LT((positions.at(57) - render::Vec3(1.0F - 2 * 0.58F, 2.0F, 3.0F)).norm(), 1e-5F);
}

TEST(BuildScene, AFineMeshOutsideOfTheTetsIsToldWithItsFile) {
  Progress quiet(true);
  tests::TemporaryDirectory dir;
  dir.write("big.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const SceneDesc scene = bar_scene({"body.0.surface.mesh='" + (dir.path() / "big.obj").string() + "'"});
  const sim::Model model = build_model(scene, quiet);
  try {
    build_surfaces(scene, model, quiet);
    ADD_FAILURE();
  } catch (const sim::InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with((dir.path() / "big.obj").string() + ": "))
        << error.what();
  }
}

TEST(BuildScene, WhatTheSceneSaysOfLooksIsDrawn) {
  Progress quiet(true);
  const SceneDesc scene =
      bar_scene({"body.0.look.roughness=0.25", "body.0.surface.smooth=false", "ground.radius=7",
                 "sky.strength=3", "background.color=[0.1, 0.2, 0.3]"});
  const sim::Model model = build_model(scene, quiet);
  const auto drawn = build_render_scene(scene, model, build_surfaces(scene, model, quiet));
  EXPECT_EQ(drawn.meshes.at(0).name, "bar");
  EXPECT_EQ(drawn.meshes.at(0).material.roughness, 0.25F);
  EXPECT_FALSE(drawn.meshes.at(0).smooth);
  EXPECT_EQ(drawn.ground.radius, 7.0F);
  EXPECT_EQ(drawn.sky.strength, 3.0F);
  EXPECT_EQ(drawn.lights.size(), scene.light.size());
  ASSERT_TRUE(drawn.background.has_value());
  EXPECT_EQ(drawn.background->y(), 0.2F);
}

TEST(BuildScene, MeshesMoveWithTheTets) {
  Progress quiet(true);
  const SceneDesc scene = bar_scene();
  const sim::Model model = build_model(scene, quiet);
  const auto surfaces = build_surfaces(scene, model, quiet);
  const auto drawn = build_render_scene(scene, model, surfaces);
  ListeningRenderer renderer;
  renderer.set_scene(drawn);
  sim::VecX q = model.initial_state().q;
  for (Eigen::Index i = 0; i < q.size(); i += 3) q[i] += 0.5;
  move_meshes(renderer, surfaces, q);
  ASSERT_EQ(renderer.meshes.at(0).size(), drawn.meshes.at(0).positions.size());
  for (std::size_t i = 0; i < renderer.meshes[0].size(); ++i) {
    const render::Vec3 moved = renderer.meshes[0][i] - drawn.meshes[0].positions[i];
    EXPECT_LT((moved - render::Vec3(0.5F, 0.0F, 0.0F)).norm(), 1e-6F);
  }
}

}  // namespace
}  // namespace lagomorph::apps
