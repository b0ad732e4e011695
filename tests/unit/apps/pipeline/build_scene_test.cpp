#include "apps/pipeline/build_scene.h"

#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/npy.h"
#include "apps/pipeline/surface_fields.h"
#include "apps/scene/scene.h"
#include "apps/scene/shutter.h"
#include "sim/error.h"
#include "tests/support/run_tree.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace build_scene_test {

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
  std::vector<std::vector<render::Vec3>> motion, previous;  // of the last mesh
  void set_motion(int, std::span<const std::vector<render::Vec3>> positions) override {
    motion.assign(positions.begin(), positions.end());
  }
  void set_previous(int, std::span<const render::Vec3> positions) override {
    previous.assign(1, {positions.begin(), positions.end()});
  }
  void update_colors(int, std::span<const render::Color>) override {}
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

/// The embedded surface is where the tets carry it at each time of the shutter.
TEST(BuildScene, MeshesAreOnTheWayOfTheTets) {
  Progress quiet(true);
  const SceneDesc scene = bar_scene({"camera.shutter=0.5"});
  const sim::Model model = build_model(scene, quiet);
  const auto surfaces = build_surfaces(scene, model, quiet);
  EXPECT_EQ(build_render_scene(scene, model, surfaces).motion_segments, motion_segments);
  EXPECT_EQ(build_render_scene(bar_scene(), model, surfaces).motion_segments, 0);
  ListeningRenderer renderer;
  renderer.set_scene(build_render_scene(scene, model, surfaces));
  // All falls from rest, by a meter until the frame.
  const sim::VecX q = model.initial_state().q;
  const auto lifted = [&](double y) {
    sim::VecX moved = q;
    for (Eigen::Index i = 1; i < q.size(); i += 3) moved[i] += y;
    return moved;
  };
  const sim::VecX rest = sim::VecX::Zero(q.size());
  sim::State state;
  state.q = q;
  state.qdot = lifted(-2.0) - q;
  const Motion motion = motion_between({.t = 0.0, .q = lifted(1.0), .qdot = rest}, state, 1.0, 0.5);
  move_meshes(renderer, surfaces, q, &motion);
  ASSERT_EQ(renderer.motion.size(), static_cast<std::size_t>(motion_segments));
  for (int step = 0; step < motion_segments; ++step) {
    const double s = 1.0 - frames_to_go(step, 0.5);
    const std::vector<render::Vec3>& then = renderer.motion[static_cast<std::size_t>(step)];
    ASSERT_EQ(then.size(), renderer.meshes[0].size());
    for (std::size_t i = 0; i < then.size(); ++i) {
      const render::Vec3 above = then[i] - renderer.meshes[0][i];
      EXPECT_LT((above - render::Vec3(0.0F, static_cast<float>(1.0 - s * s), 0.0F)).norm(), 1e-6F) << step;
    }
  }
  EXPECT_LT((renderer.previous.at(0)[0] - renderer.meshes[0][0] - render::Vec3(0, 1, 0)).norm(), 1e-6F);
}

/// The bar's bottom follows a file, each vertex its own way; all start as another file says.
TEST(BuildScene, BodiesMoveAsFilesSay) {
  Progress quiet(true);
  tests::TemporaryDirectory dir;
  const std::string bottom = "body.0.pin.1.bottom=0.001";
  const SceneDesc plain = bar_scene({bottom});
  const std::size_t n =
      sim::select_vertices(build_model(plain, quiet).mesh().X, plain.body[0].physics.pin[1], "here").size();
  std::vector<double> positions(2 * n * 3), velocities(63 * 3), shift = {0, 0, 0, 0.5, 0.25, 0};
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = 0.125 * static_cast<double>(i);
  for (std::size_t i = 0; i < velocities.size(); ++i) velocities[i] = static_cast<double>(i);
  const auto file = [&](const char* name, const std::vector<double>& values, std::vector<std::size_t> shape) {
    dir.write(name, npy_bytes(values, shape));
    return "'" + (dir.path() / name).string() + "'";
  };
  const std::string path = "body.0.pin.1.path=" + file("p.npy", positions, {2, n, 3});
  const SceneDesc scene = bar_scene(
      {bottom, path, "body.0.pin.1.path_fps=10", "body.0.velocities=" + file("v.npy", velocities, {63, 3})});
  const sim::Model model = build_model(scene, quiet);
  sim::VecX q = model.initial_state().q;
  model.held(0.0).place(0.1, q);
  std::size_t k = n * 3;
  for (int v = 0; v < 63; ++v) {
    if (model.mesh().X(v, 1) == model.mesh().X.col(1).minCoeff()) {
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(q[3 * v + axis], positions.at(k++), 1e-12);
    } else if (!model.pins().is_pinned(v)) {
      EXPECT_EQ(model.initial_state().qdot[3 * v + 1], 3 * v + 1);
    }
  }
  EXPECT_EQ(k, positions.size());
  EXPECT_EQ(bar_scene({bottom, path}).body[0].physics.pin[1].path_fps, 30.0);

  const auto told = [&](const std::vector<std::string>& overrides) -> std::string {
    try {
      build_model(bar_scene(overrides), quiet);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "nothing";
  };
  const std::string wrong = (dir.path() / "w.npy").string();
  EXPECT_EQ(
      told({bottom, "body.0.pin.1.path=" + file("w.npy", shift, {3, 2})}),
      wrong + ": has shape (3, 2); (T, 3) or (T, " + std::to_string(n) + ", 3) with T >= 1 would be right");
  EXPECT_EQ(told({"body.0.velocities=" + file("w.npy", shift, {2, 3})}),
            wrong + ": has shape (2, 3); (63, 3) would be right");
  shift[4] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(told({bottom, "body.0.pin.1.path=" + file("w.npy", shift, {2, 3})}),
            wrong + ": has a value that is not finite");
  EXPECT_TRUE(told({bottom, "body.0.pin.1.path='gone.npy'"}).ends_with("there is no such file"));
  EXPECT_TRUE(told({bottom, "body.0.pin.1.path='gone.txt'"}).ends_with("known are .npy"));
}

/// Of the tets' boundary and of the fine mesh; what is embedded moves as the tets do.
TEST(BuildScene, SurfacesAreSubdivided) {
  Progress quiet(true);
  for (const std::string mesh : {"body.0.surface.mesh=''", "body.0.surface.max_outside=0.01"}) {
    const SceneDesc coarse = bar_scene({mesh}), fine = bar_scene({mesh, "body.0.surface.subdivide=2"});
    const sim::Model model = build_model(coarse, quiet);
    const sim::Surface before = build_surfaces(coarse, model, quiet).at(0),
                       after = build_surfaces(fine, model, quiet).at(0);
    EXPECT_EQ(after.triangles().size(), 16 * before.triangles().size());
    const auto drawn = build_render_scene(fine, model, build_surfaces(fine, model, quiet));
    EXPECT_EQ(drawn.meshes.at(0).triangles.size(), after.triangles().size());
    // A constant field is carried as such, a linear one as positions are.
    const std::vector<double> ones(static_cast<std::size_t>(model.mesh().vertex_count()), 1.0);
    for (const double one : surface_values(after, ones)) EXPECT_NEAR(one, 1.0, 1e-14);
  }
  const SceneDesc cut =
      bar_scene({"body.0.surface.subdivide=2", "clip={ point = [0, 0.3, 0], normal = [0, 1, 0] }"});
  const sim::Model model = build_model(cut, quiet);
  const std::vector<sim::Surface> surfaces = drawn_surfaces(cut, model, quiet);
  EXPECT_TRUE(surfaces.at(0).coarse_edges().empty());
}

}  // namespace build_scene_test
}  // namespace lagomorph::apps
