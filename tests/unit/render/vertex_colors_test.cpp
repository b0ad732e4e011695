#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/error.h"
#include "render/renderer.h"

/// Colours of vertices in place of the material's, the same in both back ends.
namespace lagomorph::render {
namespace vertex_colors_test {

constexpr int width = 40;
constexpr int height = 20;

/// A board of 4 x 2 m across the view of settings(), lit by an even sky from all sides.
RenderScene board(const Material& material) {
  RenderScene scene;
  scene.ground.enabled = false;
  scene.sky = {Color::Ones(), Color::Ones(), 0.7F};
  Mesh mesh;
  mesh.name = "board";
  mesh.positions = {Vec3(-2, -1, 0), Vec3(2, -1, 0), Vec3(2, 1, 0), Vec3(-2, 1, 0)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material = material;
  mesh.smooth = false;
  scene.meshes = {mesh};
  return scene;
}

Camera camera() {
  CameraSettings c;
  c.position = Vec3(0, 0, 5);
  c.look_at = Vec3::Zero();
  c.orthographic = 2.0F;
  return {c, width, height};
}

class VertexColors : public testing::TestWithParam<std::tuple<const char*, int>> {
protected:
  std::unique_ptr<Renderer> make(const RenderScene& scene) const {
    RenderSettings s;
    s.backend = std::get<0>(GetParam());
    s.width = width;
    s.height = height;
    s.samples = 256;
    s.path.filter = "box";
    s.path.filter_radius = 0.5F;
    s.raster.multisample = std::get<1>(GetParam());
    s.channels = {"depth", "body_id"};
    auto renderer = make_renderer(s, 2);
    renderer->set_scene(scene);
    return renderer;
  }
  static Color pixel(const Image& image, int x, int y) {
    const float* at = image.find("color")->values.data() + 3 * (y * width + x);
    return {at[0], at[1], at[2]};
  }
};

const Color left(0.9F, 0.1F, 0.02F), right(0.05F, 0.3F, 0.8F);

/// Across the board from left to right.
std::vector<Color> across() { return {left, right, right, left}; }

TEST_P(VertexColors, AreInterpolatedAndLitAsTheMaterialIs) {
  for (const float metallic : {0.0F, 1.0F}) {
    const Material material{Color(0.5F, 0.5F, 0.5F), 0.6F, metallic, 1.5F};
    RenderScene scene = board(material);
    scene.meshes[0].colors = across();
    const Image image = make(scene)->render(camera(), {});
    for (const int x : {1, 12, 20, 33, 38}) {
      const float along = (static_cast<float>(x) + 0.5F) / width;
      Material plain = material;
      plain.base_color = (1.0F - along) * left + along * right;
      const Image expected = make(board(plain))->render(camera(), {});
      for (const int y : {2, 10, 17}) {
        const Color difference = pixel(image, x, y) - pixel(expected, x, y);
        EXPECT_LT(difference.abs().maxCoeff(), 4e-3F) << metallic << " " << x << " " << y;
      }
    }
  }
}

TEST_P(VertexColors, OfTheMaterialChangeNothing) {
  const Material material{Color(0.5F, 0.25F, 0.75F), 0.4F, 0.0F, 1.5F};
  RenderScene scene = board(material);
  const Image plain = make(scene)->render(camera(), {});
  scene.meshes[0].colors.assign(4, material.base_color);
  const Image colored = make(scene)->render(camera(), {});
  for (const char* channel : {"depth", "body_id"})
    EXPECT_EQ(plain.find(channel)->values, colored.find(channel)->values);
  for (int x = 0; x < width; ++x)
    EXPECT_LT((pixel(plain, x, 9) - pixel(colored, x, 9)).abs().maxCoeff(), 1e-5F) << x;
}

TEST_P(VertexColors, OfOneMeshLeaveTheOthers) {
  RenderScene scene = board({});
  Mesh small = scene.meshes[0];
  small.name = "small";
  for (Vec3& p : small.positions) p = 0.4F * p + Vec3(0, 0, 1);
  small.material.base_color = Color(0.125F, 0.5F, 0.25F);
  scene.meshes.push_back(small);
  const Image plain = make(scene)->render(camera(), {});
  scene.meshes[0].colors = across();
  scene.lights.resize(1);  // which the camera sees
  scene.lights[0].radiance = 0.0F;
  scene.lights[0].visible = true;
  const Image image = make(scene)->render(camera(), {});
  EXPECT_LT((pixel(plain, 20, 10) - pixel(image, 20, 10)).abs().maxCoeff(), 1e-5F);
  EXPECT_GT((pixel(plain, 2, 10) - pixel(image, 2, 10)).abs().maxCoeff(), 0.1F);
}

TEST_P(VertexColors, Change) {
  RenderScene scene = board({});
  scene.meshes[0].colors.assign(4, Color(0.5F, 0.5F, 0.5F));
  const auto renderer = make(scene);
  renderer->render(camera(), {});
  renderer->update_colors(0, across());
  const Image changed = renderer->render(camera(), {});
  scene.meshes[0].colors = across();
  EXPECT_EQ(changed.find("color")->values, make(scene)->render(camera(), {}).find("color")->values);
  scene.meshes[0].colors.clear();
  renderer->set_scene(scene);
  EXPECT_EQ(renderer->render(camera(), {}).find("color")->values,
            make(scene)->render(camera(), {}).find("color")->values);
}

TEST_P(VertexColors, WrongOnesAreTold) {
  RenderScene scene = board({});
  const auto message = [](const std::function<void()>& act) -> std::string {
    try {
      act();
    } catch (const SettingsError& error) {
      return error.what();
    }
    return "no error";
  };
  std::vector<Color> colors = across();
  const auto plain = make(scene);
  EXPECT_NE(message([&] { plain->update_colors(0, colors); }).find("has 4 colors for 0 vertices"),
            std::string::npos);
  scene.meshes[0].colors = colors;
  const auto renderer = make(scene);
  EXPECT_NE(message([&] { renderer->update_colors(1, colors); }).find("mesh 1 is not one"),
            std::string::npos);
  colors.pop_back();
  EXPECT_NE(message([&] { renderer->update_colors(0, colors); }).find("has 3 colors for 4 vertices"),
            std::string::npos);
  for (const float wrong : {1.5F, -0.1F, std::numeric_limits<float>::quiet_NaN()}) {
    scene.meshes[0].colors[2].y() = wrong;
    EXPECT_NE(message([&] { make(scene); }).find("mesh 'board' color"), std::string::npos) << wrong;
    EXPECT_NE(message([&] { renderer->update_colors(0, scene.meshes[0].colors); }).find("color"),
              std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(BackEnds, VertexColors,
                         testing::Values(std::tuple("raster", 1), std::tuple("raster", 4),
                                         std::tuple("path", 4)),
                         [](const auto& info) {
                           return std::get<0>(info.param) + std::to_string(std::get<1>(info.param));
                         });

}  // namespace vertex_colors_test
}  // namespace lagomorph::render
