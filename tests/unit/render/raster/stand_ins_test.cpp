#include "render/raster/stand_ins.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "tests/unit/render/raster/shapes.h"

namespace lagomorph::render::raster {
namespace stand_ins_test {

/// A square metre at a place around the origin.
AreaLight lamp(const Vec3& position, float radiance, const char* name) {
  AreaLight light;
  light.position = position;
  light.look_at = Vec3::Zero();
  light.size = Vec2(1.0F, 1.0F);
  light.radiance = radiance;
  light.name = name;
  return light;
}

Sun sun_of(float irradiance, const char* name) {
  Sun sun;
  sun.irradiance = irradiance;
  sun.name = name;
  return sun;
}

RenderScene ball() {
  RenderScene scene;
  scene.meshes = {sphere(Vec3::Zero(), 0.5F, 12)};
  return scene;
}

using Names = std::vector<std::string>;

/// Of the lights, squares that stand for suns having none, and of the suns.
Names names(const RenderScene& scene) {
  Names all;
  for (const AreaLight& light : scene.lights) all.push_back(light.name);
  for (const Sun& sun : scene.suns) all.push_back(sun.name);
  return all;
}

TEST(StandIns, FourLightsAreAllDrawn) {
  RenderScene scene = ball();
  scene.lights = {lamp({0, 2, 0}, 1.0F, "a"), lamp({2, 2, 0}, 0.0F, "b")};
  scene.suns = {sun_of(0.0F, "c"), sun_of(1.0F, "d")};
  EXPECT_EQ(names(with_stand_ins(scene)), (Names{"a", "b", "", "", "c", "d"}));
  EXPECT_EQ(stand_in_remarks({}, scene), (Names{"a sun is a far square light of its size"}));
}

TEST(StandIns, TheStrongestFourAreDrawnInTheirOrder) {
  RenderScene scene = ball();
  scene.lights = {lamp({0, 2, 0}, 3.0F, "light.0"), lamp({0, 2, 0}, 1.0F, "light.1"),
                  lamp({0, 2, 0}, 3.0F, "light.2"), lamp({0, 2, 0}, 2.0F, "light.3"),
                  lamp({0, 2, 0}, 8.0F, "light.4"), lamp({0, 2, 0}, 2.0F, "light.5")};
  EXPECT_EQ(names(with_stand_ins(scene)), (Names{"light.0", "light.2", "light.3", "light.4"}));
  EXPECT_EQ(stand_in_remarks({}, scene),
            (Names{"draws the light of at most 4 lights, the strongest: leaves out that of light.1, "
                   "light.5; --backend path draws all"}));
  scene.lights[1].size = Vec2(3.0F, 3.0F);
  scene.lights[4].color = Color(0.0F, 0.0F, 1.0F);  // of little luminance
  EXPECT_EQ(names(with_stand_ins(scene)), (Names{"light.0", "light.1", "light.2", "light.3"}));
}

/// A lamp of a square metre, 2 m away, lights what faces it with a quarter of its radiance.
TEST(StandIns, ASunIsHeldAgainstLightsByWhatItGivesTheMeshes) {
  RenderScene scene = ball();
  for (const char* name : {"a", "b", "c", "d"}) scene.lights.push_back(lamp({0, 2, 0}, 8.0F, name));
  scene.lights[2].radiance = 7.0F;
  scene.suns = {sun_of(1.7F, "sun")};
  EXPECT_EQ(names(with_stand_ins(scene)), (Names{"a", "b", "c", "d"}));
  EXPECT_EQ(stand_in_remarks({}, scene), (Names{"draws the light of at most 4 lights, the strongest: leaves "
                                                "out that of sun; --backend path draws all"}));
  scene.suns = {sun_of(1.8F, "sun")};
  EXPECT_EQ(names(with_stand_ins(scene)), (Names{"a", "b", "d", "", "sun"}));
  scene.lights.clear();
  scene.suns.assign(6, sun_of(1.0F, ""));
  scene.suns[5].irradiance = 2.0F;
  EXPECT_EQ(with_stand_ins(scene).suns.size(), 4U);
  EXPECT_EQ(with_stand_ins(scene).suns.back().irradiance, 2.0F);
  EXPECT_EQ(stand_in_remarks({}, scene).back(),
            "draws the light of at most 4 lights, the strongest: leaves out that of light 3, light 4; "
            "--backend path draws all");
}

/// Whose light is left out, but not they themselves.
TEST(StandIns, AllVisibleLightsAreSeen) {
  for (const char* look : {"plain", "chrome"}) {
    RenderScene scene = ball();
    if (look == std::string("chrome")) scene.meshes[0].material = {Color::Constant(0.9F), 0.0F, 1.0F, 1.5F};
    scene.sky.strength = 0.0F;
    for (int k = 0; k < 4; ++k) scene.lights.push_back(lamp({0, 9, 0}, 50.0F, "strong"));
    scene.lights.push_back(lamp({-1.5F, 0.5F, 0}, 0.7F, "weak"));
    scene.lights.back().look_at = Vec3(-1.5F, 0.5F, 5.0F);
    scene.lights.back().size = Vec2(0.4F, 0.4F);
    scene.lights.back().visible = true;
    CameraSettings camera;
    camera.position = Vec3(0, 0.5F, 5.0F);
    camera.look_at = Vec3(0, 0.5F, 0);
    RenderSettings settings;
    settings.width = settings.height = 64;
    const auto renderer = make_renderer(settings, 1);
    renderer->set_scene(scene);
    const Camera from(camera, 64, 64);
    const Image image = renderer->render(from, {});
    const Vec2 at = from.project(scene.lights.back().position);
    const auto pixel = static_cast<std::size_t>(at.y()) * 64 + static_cast<std::size_t>(at.x());
    EXPECT_FLOAT_EQ(image.find(color_channel)->values[3 * pixel], 0.7F) << look;
  }
}

TEST(StandIns, APictureIsThatOfTheStrongest) {
  RenderSettings settings;
  settings.backend = "raster";
  settings.width = 48;
  settings.height = 32;
  settings.raster.shadow_map = 256;
  const auto picture = [&](const RenderScene& scene) {
    const auto renderer = make_raster_renderer(settings, 2);
    renderer->set_scene(scene);
    return renderer->render(Camera(CameraSettings(), settings.width, settings.height), {})
        .channels()
        .front()
        .values;
  };
  RenderScene few = ball();
  few.lights = {lamp({0, 2, 0}, 3.0F, ""), lamp({2, 2, 0}, 4.0F, ""), lamp({-2, 2, 1}, 5.0F, "")};
  few.suns = {sun_of(3.0F, "")};
  RenderScene many = few;
  many.lights.insert(many.lights.begin() + 1, lamp({0, 2, 2}, 2.0F, ""));
  many.lights.front().visible = few.lights.front().visible = true;
  many.suns.insert(many.suns.begin(), sun_of(0.1F, ""));
  many.suns.front().visible = true;
  EXPECT_EQ(picture(many), picture(few));
}

}  // namespace stand_ins_test
}  // namespace lagomorph::render::raster
