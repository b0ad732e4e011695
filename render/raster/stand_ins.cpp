#include "render/raster/stand_ins.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <numbers>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>

#include <Eigen/Geometry>

#include "render/raster/frame_block.h"
#include "render/raster/sky_sun.h"

namespace lagomorph::render::raster {
namespace {

using std::numbers::pi;

/// So far that its light is parallel to a degree over the ground, and so near that single precision still
/// resolves its shadows.
float distance_of_suns(const RenderScene& scene) {
  Eigen::AlignedBox3f box;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3& p : mesh.positions) box.extend(p);
  }
  const float meshes = box.isEmpty() ? 1.0F : box.diagonal().norm();
  return std::max(100.0F * meshes, scene.ground.enabled ? 50.0F * scene.ground.radius : 0.0F);
}

Vec3 middle_of(const RenderScene& scene) {
  Eigen::AlignedBox3f box;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3& p : mesh.positions) box.extend(p);
  }
  return box.isEmpty() ? scene.ground.center : Vec3(box.center());
}

AreaLight far_square(const Sun& sun, const Vec3& middle, float distance) {
  const float angle = solid_angle(sun);
  AreaLight light;
  light.look_at = middle;
  light.position = middle - distance * sun.direction.normalized();
  light.size = Vec2::Constant(distance * std::sqrt(angle));
  light.color = sun.color;
  light.radiance = sun.irradiance / angle;
  return light;
}

float luminance(const Color& c) { return 0.2126F * c.x() + 0.7152F * c.y() + 0.0722F * c.z(); }

/// The square of the middle one of the area lights' distances from the meshes' middle.
float usual_squared_distance(const RenderScene& scene, const Vec3& middle) {
  std::vector<float> squares;
  squares.reserve(scene.lights.size());
  for (const AreaLight& light : scene.lights) squares.push_back((light.position - middle).squaredNorm());
  if (squares.empty()) return 1.0F;
  const auto half = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), half, squares.end());
  return *half;
}

/// How strong the lights are, then the suns, see with_stand_ins().
std::vector<float> strengths(const RenderScene& scene) {
  std::vector<float> all;
  all.reserve(scene.lights.size() + scene.suns.size());
  for (const AreaLight& light : scene.lights)
    all.push_back(light.size.prod() * light.radiance * luminance(light.color));
  const float square = usual_squared_distance(scene, middle_of(scene));
  for (const Sun& sun : scene.suns) all.push_back(square * sun.irradiance * luminance(sun.color));
  return all;
}

/// Of the lights, then of the suns, whether each is among those drawn; of equal ones the first are.
std::vector<bool> which_are_drawn(const RenderScene& scene) {
  const std::size_t count = scene.lights.size() + scene.suns.size(), most = most_lights;
  if (count <= most) return std::vector<bool>(count, true);
  const std::vector<float> strength = strengths(scene);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return strength[a] > strength[b]; });
  std::vector<bool> drawn(count, false);
  for (std::size_t i = 0; i < most; ++i) drawn[order[i]] = true;
  return drawn;
}

std::string names_of_left_out(const RenderScene& scene, const std::vector<bool>& drawn) {
  std::string names;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i]) continue;
    const std::size_t lights = scene.lights.size();
    const std::string& name = i < lights ? scene.lights[i].name : scene.suns[i - lights].name;
    names += (names.empty() ? "" : ", ") + (name.empty() ? "light " + std::to_string(i) : name);
  }
  return names;
}

/// The sun of the scene's map of the sky, if it has one, out of the map and last of the suns; left where it
/// is if it would not be among those drawn, for the sky shines all the same.
std::optional<Sun> take_sun_of_sky(RenderScene& scene) {
  std::optional<SkySun> found = sun_of_sky(scene.sky);
  if (!found) return std::nullopt;
  scene.suns.push_back(found->sun);
  if (!which_are_drawn(scene).back()) {
    scene.suns.pop_back();
    return std::nullopt;
  }
  scene.sky.map = std::move(found->rest);
  return found->sun;
}

}  // namespace

float solid_angle(const Sun& sun) {
  const double chord = 2.0 * std::sin(static_cast<double>(sun.angle) * pi / 720.0);
  return static_cast<float>(pi * chord * chord);
}

RenderScene with_stand_ins(const RenderScene& scene) {
  RenderScene drawn = scene;
  take_sun_of_sky(drawn);
  const std::vector<bool> is_drawn = which_are_drawn(drawn);
  const Vec3 middle = middle_of(drawn);
  const float distance = distance_of_suns(drawn);
  const auto lights = std::exchange(drawn.lights, {});
  const auto suns = std::exchange(drawn.suns, {});
  drawn.meshes.clear();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (is_drawn[i]) drawn.lights.push_back(lights[i]);
  }
  for (std::size_t i = 0; i < suns.size(); ++i) {
    if (!is_drawn[lights.size() + i]) continue;
    drawn.suns.push_back(suns[i]);
    drawn.lights.push_back(far_square(suns[i], middle, distance));
  }
  return drawn;
}

std::vector<std::string> stand_in_remarks(const CameraSettings& camera, const RenderScene& given) {
  std::vector<std::string> remarks;
  if (camera.f_stop > 0.0F && !camera.orthographic)
    remarks.emplace_back("camera.f_stop: everything is drawn sharp");
  if (given.motion_segments > 0)
    remarks.emplace_back(
        "camera.shutter: drawn without motion blur of bodies or camera, as all is when the shutter closes");
  RenderScene scene = given;
  const std::optional<Sun> of_sky = take_sun_of_sky(scene);
  const std::vector<bool> is_drawn = which_are_drawn(scene);
  const auto suns = is_drawn.begin() + static_cast<std::ptrdiff_t>(scene.lights.size());
  if (std::find(suns, is_drawn.end(), true) != is_drawn.end())
    remarks.emplace_back("a sun is a far square light of its size");
  if (of_sky) {
    std::ostringstream line;
    line << "sky.image: its sun, " << std::setprecision(2) << of_sky->angle
         << " degrees wide, lights as a sun of its own";
    remarks.push_back(line.str());
  }
  if (std::find(is_drawn.begin(), is_drawn.end(), false) != is_drawn.end()) {
    remarks.push_back("draws the light of at most " + std::to_string(most_lights) +
                      " lights, the strongest: leaves out that of " + names_of_left_out(scene, is_drawn) +
                      "; --backend path draws all");
  }
  return remarks;
}

}  // namespace lagomorph::render::raster
