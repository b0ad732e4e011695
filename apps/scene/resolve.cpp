#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/error.h"
#include "apps/nearest.h"
#include "apps/overlay/caption.h"
#include "apps/overlay/energy_plot.h"
#include "apps/scene/read.h"
#include "apps/scene/scene.h"
#include "apps/utf8.h"
#include "render/channel_png.h"
#include "render/channels.h"
#include "sim/error.h"
#include "sim/materials/presets.h"
#include "sim/materials/table.h"
#include "sim/mesh_io.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

/// Names become file names and lines of text files.
void check_name(const std::string& name, const std::string& key, const Places& places) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  const char* fault = nullptr;
  if (name.empty()) fault = "it is empty";
  if (name == "." || name == "..") fault = "it is a folder";
  if (name.find_first_of("/\\\"") != std::string::npos) fault = "it has a slash or quote";
  if (std::any_of(name.begin(), name.end(), control)) fault = "it has control characters";
  if (!is_utf8(name)) fault = "it is not UTF-8";
  if (name.size() > 200) fault = "it is longer than 200 bytes";
  if (fault != nullptr) {
    wrong_input(fmt::format("{}{} = '{}' must be a plain file name: {}", places.of(key), key, name, fault));
  }
}

/// One set of constants describes a material; with none given it is young and poisson, the preset's or the
/// usual.
void resolve_material(sim::MaterialSettings& m, const std::string& path, const Places& places) {
  try {
    sim::check_material(m, places.of(path) + path);
  } catch (const sim::InputError& error) {
    wrong_input(error.what());
  }
  if (m.mu || m.C || m.C10) return;
  const sim::Preset* const preset = sim::find_preset(m.preset, path);
  if (!m.young && m.data.empty()) m.young = preset != nullptr ? preset->young : 1e5;
  if (!m.poisson) m.poisson = preset != nullptr ? preset->poisson : 0.3;
}

void check_selector(const sim::Selector& s, const std::string& path, const Places& places) {
  if (s.box && (s.box->min.array() > s.box->max.array()).any()) {
    wrong_input(fmt::format("{}{}.box: the first corner must be the lesser one in x, y and z",
                            places.of(path + ".box"), path));
  }
  if (s.plane && (s.plane->normal.array() == 0.0).all()) {
    wrong_input(fmt::format("{}{}.plane.normal must not be 0", places.of(path + ".plane.normal"), path));
  }
}

void check_selects(const sim::Selector& s, const std::string& path, const Places& places) {
  if (s.is_empty()) {
    wrong_input(fmt::format("{}{} selects nothing; give vertices, box, sphere, plane, top or bottom",
                            places.of(path), path));
  }
  check_selector(s, path, places);
}

void check_pin(const sim::PinSettings& p, const std::string& path, const Places& places) {
  check_selects(p, path, places);
  if (p.axes.empty()) {
    wrong_input(fmt::format("{}{}.axes is empty; give some of x, y, z", places.of(path + ".axes"), path));
  }
  if (!p.path.empty() && !p.key.empty()) {
    wrong_input(
        fmt::format("{}{} has both keys and a path; give one of them", places.of(path + ".path"), path));
  }
  for (std::size_t i = 1; i < p.key.size(); ++i) {
    if (p.key[i].time > p.key[i - 1].time) continue;
    const std::string time = fmt::format("{}.key.{}.time", path, i);
    wrong_input(fmt::format("{}{} = {} must be later than the {} before it", places.of(time), time,
                            p.key[i].time, p.key[i - 1].time));
  }
}

void check_load(const sim::LoadSettings& l, const std::string& path, const Places& places) {
  check_selector(l, path, places);
  for (std::size_t i = 1; i < l.curve.size(); ++i) {
    if (l.curve[i][0] > l.curve[i - 1][0]) continue;
    wrong_input(fmt::format("{}{}.curve: time {} must be later than the {} before it",
                            places.of(path + ".curve"), path, l.curve[i][0], l.curve[i - 1][0]));
  }
}

/// Pins, springs and loads.
void resolve_boundary(BodyDesc& body, double fps, const std::string& path, const Places& places) {
  sim::BodySettings& p = body.physics;
  const auto each = [&](auto& list, const char* name, std::vector<std::string>& at, auto&& check) {
    for (std::size_t j = 0; j < list.size(); ++j) {
      const std::string item = fmt::format("{}.{}.{}", path, name, j);
      check(list[j], item, places);
      at.push_back(places.of(item) + item);
    }
  };
  each(p.pin, "pin", body.pin_places, check_pin);
  each(p.spring, "spring", body.spring_places, check_selects);
  each(p.load, "load", body.load_places, check_load);
  for (std::size_t j = 0; j < p.pin.size(); ++j) {
    sim::PinSettings& pin = p.pin[j];
    if (pin.path.empty() && pin.path_fps)
      wrong_input(fmt::format("{}.path_fps has no effect without a path", body.pin_places[j]));
    if (!pin.path.empty() && !pin.path_fps) pin.path_fps = fps;
  }
}

/// What a region's material leaves open is the body's, which is resolved.
void complete_material(sim::MaterialSettings& m, const sim::MaterialSettings& body, const std::string& path,
                       const Places& places) {
  const bool has_preset = places.has(path + ".preset");
  if (!places.has(path + ".model")) m.model = body.model;
  if (!places.has(path + ".moduli") && m.model == body.model) m.moduli = body.moduli;
  if (!m.fibre) m.fibre = body.fibre;
  using Constant = std::optional<double> sim::MaterialSettings::*;
  using Set = std::vector<Constant>;
  using M = sim::MaterialSettings;
  const auto any = [](const M& of, const Set& set) {
    return std::any_of(set.begin(), set.end(), [&](Constant c) { return (of.*c).has_value(); });
  };
  const auto complete = [&](const Set& set) {
    for (const Constant c : set)
      if (!(m.*c)) m.*c = body.*c;
  };
  // A set that is begun is completed; without one it is the body's.
  for (const Set& set : {Set{&M::mu, &M::lambda}, Set{&M::C, &M::D}, Set{&M::C10, &M::C01, &M::bulk}}) {
    if (any(m, set)) return complete(set);
  }
  const Set own = {&M::C, &M::D, &M::C10, &M::C01, &M::bulk};
  if (!m.young && !m.poisson && m.data.empty() && !has_preset) {
    if (m.model != body.model && any(body, own))
      wrong_input(fmt::format("{}{}: the body's constants are of {}; give young and poisson", places.of(path),
                              path, body.model));
    complete({&M::mu, &M::lambda});
    complete(own);
  }
  if (has_preset) return;
  if (!m.young && m.data.empty()) m.young = body.young;
  if (!m.poisson) m.poisson = body.poisson;
  if (m.data.empty() && m.model == body.model) m.data = body.data;
}

void resolve_regions(sim::BodySettings& body, const std::string& path, const Places& places) {
  for (std::size_t j = 0; j < body.region.size(); ++j) {
    const std::string at = fmt::format("{}.region.{}", path, j);
    sim::RegionSettings& region = body.region[j];
    region.where = places.of(at) + at;
    if (!region.material) continue;
    complete_material(*region.material, body.material, at + ".material", places);
    resolve_material(*region.material, at + ".material", places);
  }
  for (std::size_t j = 0; j < body.field.size(); ++j) {
    const std::string at = fmt::format("{}.field.{}", path, j);
    body.field[j].where = places.of(at) + at;
  }
}

/// The usual strengths of an image and of the physical model are others than the gradient's. The scene of a
/// run has all defaults written out, so what --set makes of its sky has the usual strength of that.
void resolve_sky(SkyDesc& sky, const Places& places) {
  const bool becomes_another = (places.overridden("sky.model") || places.overridden("sky.image")) &&
                               !places.overridden("sky.strength");
  if (places.has("sky.strength") && !becomes_another) return;
  if (!sky.image.empty()) {
    sky.strength = 1.0F;
  } else if (sky.model == "physical") {
    sky.strength = 5.0F;
  } else if (becomes_another) {
    static const SkyDesc usual;
    sky.strength = usual.strength;
  }
}

/// From below, the ground would be all that is seen; of panels each leaves it out for itself.
void resolve_ground(SceneDesc& scene, const Places& places) {
  if (scene.camera.view == "bottom" && scene.panel.empty() && !places.overridden("ground.enabled"))
    scene.ground.enabled = false;
}

void check_range(const std::optional<std::array<double, 2>>& range, const std::string& key,
                 const Places& places) {
  if (!range || (*range)[0] < (*range)[1]) return;
  wrong_input(fmt::format("{}{} = [{}, {}]: the first must be less than the second", places.of(key), key,
                          (*range)[0], (*range)[1]));
}

void check_looks(const SceneDesc& scene, const Places& places) {
  for (std::size_t i = 0; i < scene.body.size(); ++i)
    check_range(scene.body[i].shown.range, fmt::format("body.{}.look.range", i), places);
  check_range(scene.energy_plot.range, "energy_plot.range", places);
  if (scene.energy_plot.curves.empty()) {
    wrong_input(fmt::format("{}energy_plot.curves is empty; give some of {}", places.of("energy_plot.curves"),
                            fmt::join(energy_curves(), ", ")));
  }
  if (scene.ground.fade_start >= scene.ground.radius) {
    const char* key = places.has("ground.fade_start") ? "ground.fade_start" : "ground.radius";
    wrong_input(fmt::format("{}ground.fade_start = {} must be less than ground.radius = {}", places.of(key),
                            scene.ground.fade_start, scene.ground.radius));
  }
  for (std::size_t i = 0; i < scene.light.size(); ++i) {
    const std::string path = fmt::format("light.{}", i);
    if (scene.light[i].kind == "sun") {
      if (scene.light[i].direction.cwiseAbs().maxCoeff() > 0.0F) continue;
      wrong_input(fmt::format("{}{}.direction must not be 0", places.of(path + ".direction"), path));
    }
    if (scene.light[i].position != scene.light[i].look_at) continue;
    std::string key = path + ".look_at";
    if (!places.has(key)) key = path + ".position";
    wrong_input(fmt::format("{}{}.position and {}.look_at are the same point", places.of(key), path, path));
  }
  try {
    caption_text(scene.caption.text, {});
  } catch (const Error& e) {
    wrong_input(fmt::format("{}caption.text: {}", places.of("caption.text"), e.what()));
  }
  if (scene.clip && scene.clip->normal.cwiseAbs().maxCoeff() == 0.0)
    wrong_input(fmt::format("{}clip.normal must not be 0", places.of("clip.normal")));
  std::set<std::string> channels;
  for (const std::string& channel : scene.render.channels) {
    if (!channels.insert(channel).second) {
      wrong_input(fmt::format("{}render.channels has '{}' twice", places.of("render.channels"), channel));
    }
    if (scene.render.channel_format == "png" && channel != render::statistics_channel &&
        !render::fits_png(channel)) {
      wrong_input(
          fmt::format("{}render.channels: '{}' has values that a PNG does not hold; give "
                      "render.channel_format = \"npy\" or \"exr\"",
                      places.of("render.channels"), channel));
    }
  }
}

void check_file(const SceneDesc& scene, const std::string& name, const std::string& key,
                const std::vector<std::string>& extensions, const Places& places) {
  if (name.empty()) return;
  std::string extension = fs::path(name).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    wrong_input(fmt::format("{}{} = '{}' has an unknown extension; known are {}", places.of(key), key, name,
                            joined(extensions)));
  }
  std::error_code none;
  if (!fs::exists(scene.directory / name, none)) {
    wrong_input(fmt::format("{}{} = '{}': there is no such file", places.of(key), key, name));
  }
  if (!fs::is_regular_file(scene.directory / name, none)) {
    wrong_input(fmt::format("{}{} = '{}' is not a file", places.of(key), key, name));
  }
  for (const fs::path& file : mesh_files(scene.directory / name)) {
    if (fs::exists(file, none)) continue;
    wrong_input(fmt::format("{}{} = '{}' needs '{}' beside it: there is no such file", places.of(key), key,
                            name, file.filename().string()));
  }
}

}  // namespace

void resolve_scene(SceneDesc& scene, const Places& places, const std::string& stem) {
  if (!places.has("name")) scene.name = stem;
  check_name(scene.name, "name", places);
  if (scene.time.integrator == "static" && !places.has("time.frames")) scene.time.frames = 2;
  if (scene.body.empty())
    wrong_input(places.of("body") + "the scene has no body; give at least one [[body]] with a mesh");
  std::set<std::string> body_names;
  for (std::size_t i = 0; i < scene.body.size(); ++i) {
    const std::string path = fmt::format("body.{}", i);
    BodyDesc& body = scene.body[i];
    if (!places.has(path + ".name")) body.physics.name = fmt::format("body{}", i);
    check_name(body.physics.name, path + ".name", places);
    if (!body_names.insert(body.physics.name).second) {
      wrong_input(fmt::format("{}{}.name = '{}' is another body's name", places.of(path + ".name"), path,
                              body.physics.name));
    }
    if (body.mesh.empty()) wrong_input(fmt::format("{}{}.mesh is empty", places.of(path + ".mesh"), path));
    resolve_material(body.physics.material, path + ".material", places);
    resolve_regions(body.physics, path, places);
    resolve_boundary(body, scene.time.fps, path, places);
  }
  check_views(scene, places);
  check_looks(scene, places);
  resolve_sky(scene.sky, places);
  resolve_ground(scene, places);
}

void check_scene_files(const SceneDesc& scene, const Places& places) {
  check_file(scene, scene.sky.image, "sky.image", {".hdr"}, places);
  for (std::size_t i = 0; i < scene.body.size(); ++i) {
    const std::string path = fmt::format("body.{}", i);
    check_file(scene, scene.body[i].mesh, path + ".mesh", sim::tet_mesh_extensions(), places);
    check_file(scene, scene.body[i].surface.mesh, path + ".surface.mesh", sim::tri_mesh_extensions(), places);
    const sim::BodySettings& body = scene.body[i].physics;
    check_file(scene, body.velocities, path + ".velocities", {".npy"}, places);
    for (std::size_t j = 0; j < body.pin.size(); ++j)
      check_file(scene, body.pin[j].path, fmt::format("{}.pin.{}.path", path, j), {".npy"}, places);
    for (std::size_t j = 0; j < body.field.size(); ++j)
      check_file(scene, body.field[j].file, fmt::format("{}.field.{}.file", path, j), {".npy"}, places);
  }
}

}  // namespace lagomorph::apps
