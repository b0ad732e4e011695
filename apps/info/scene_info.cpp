#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "apps/info/info.h"
#include "apps/pipeline/build_scene.h"
#include "apps/run/disk_space.h"
#include "apps/scene/scene.h"
#include "sim/fields.h"
#include "sim/integrator.h"
#include "sim/placement.h"
#include "sim/tissue.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

int pinned_of(const sim::Model& model, const sim::Range& vertices) {
  const std::vector<int>& pinned = model.pins().vertices();  // ascending
  return static_cast<int>(std::lower_bound(pinned.begin(), pinned.end(), vertices.end) -
                          std::lower_bound(pinned.begin(), pinned.end(), vertices.begin));
}

/// "young 1e5 .. 4e5 Pa" of each constant of a body that is not the same everywhere, and its models.
struct Ranges {
  std::map<std::string, std::pair<double, double>> of;  // least and largest, by key
  std::map<std::string, int> models;                    // tets of each

  void add(const std::string& key, double value) {
    const auto [at, is_new] = of.try_emplace(key, value, value);
    if (is_new) return;
    at->second.first = std::min(at->second.first, value);
    at->second.second = std::max(at->second.second, value);
  }
};

Ranges ranges_of(const sim::BodyInput& body) {
  sim::TetMesh placed = body.mesh;
  sim::place(placed.X, body.settings);
  const sim::Tissue tissue = sim::make_tissue(placed, body.settings, "body '" + body.settings.name + "'");
  Ranges ranges;
  for (const double density : tissue.densities) ranges.add("density", density);
  for (const sim::ElasticBody& part : tissue.parts) {
    ranges.models[part.material.model] += part.tets.size();
    for (const std::string& key : sim::field_keys()) {
      if (const auto value = sim::constant_of(part.material, key)) ranges.add(key, *value);
    }
  }
  return ranges;
}

void add_ranges(Report& report, const sim::BodyInput& body, nlohmann::ordered_json& json) {
  if (body.settings.region.empty() && body.settings.field.empty()) return;
  const Ranges ranges = ranges_of(body);
  std::string models, constants;
  for (const auto& [model, tets] : ranges.models) {
    models += fmt::format("{}{} tets of {}", models.empty() ? "" : ", ", count_text(tets), model);
    json["models"][model] = tets;
  }
  for (const auto& [key, range] : ranges.of) {
    constants += fmt::format("{}{} {} .. {}", constants.empty() ? "" : ", ", key, number_text(range.first),
                             number_text(range.second));
    json["ranges"][key] = {range.first, range.second};
  }
  report.add_text("", models);
  report.add_text("", constants);
}

std::string range_text(double low, double high) {
  const std::string first = number_text(low), last = number_text(high);
  return first == last ? first : first + " .. " + last;
}

/// How a body's material behaves at rest, whatever its model's own constants; fibres, springs and loads.
void add_behaviour(Report& report, const sim::BodySettings& settings, const sim::Range& tets,
                   const std::vector<sim::Field>& at_rest, nlohmann::ordered_json& json) {
  std::string text;
  for (const sim::Field& field : at_rest) {
    const auto [low, high] =
        std::minmax_element(field.elements.begin() + tets.begin, field.elements.begin() + tets.end);
    text += fmt::format("{}{} {}{}{}", text.empty() ? "at rest " : ", ", field.info.name,
                        range_text(*low, *high), *field.info.unit == 0 ? "" : " ", field.info.unit);
    json["at_rest"][field.info.name] = {*low, *high};
  }
  report.add_text("", text);
  std::string more;
  if (settings.material.fibre) {
    const sim::FibreSettings& f = *settings.material.fibre;
    more += fmt::format(", fibres along {} of {} Pa", point_text(f.direction), number_text(f.stiffness));
  }
  const auto count = [&](std::size_t n, const char* what) {
    if (n > 0) more += fmt::format(", {} {}{}", n, what, n == 1 ? "" : "s");
  };
  count(settings.pin.size(), "pin");
  count(settings.spring.size(), "spring");
  count(settings.load.size(), "load");
  json["pins"] = settings.pin.size();
  json["springs"] = settings.spring.size();
  json["loads"] = settings.load.size();
  if (!more.empty()) report.add_text("", more.substr(2));
}

void add_bodies(Report& report, const SceneDesc& scene, const std::vector<sim::BodyInput>& inputs,
                const sim::Model& model, const std::vector<sim::Surface>& surfaces) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  const auto at_rest = sim::fields_of(model, model.initial_state().q, {"young", "poisson", "density"});
  for (std::size_t i = 0; i < scene.body.size(); ++i) {
    const BodyDesc& described = scene.body[i];
    const sim::Body& body = model.mesh().bodies[i];
    const int pinned = pinned_of(model, body.vertices);
    const std::size_t triangles = surfaces[i].triangles().size();
    const std::string drawn = described.surface.mesh.empty() ? "their boundary" : described.surface.mesh;
    report.add_text("body " + body.name,
                    fmt::format("{} tets, {} vertices ({} pinned) of {}", count_text(body.tets.size()),
                                count_text(body.vertices.size()), count_text(pinned), described.mesh));
    report.add_text(
        "", fmt::format("{}, {} kg/m^3, drawn by {} triangles of {}", described.physics.material.model,
                        described.physics.density, count_text(static_cast<long long>(triangles)), drawn));
    all.push_back({{"name", body.name},
                   {"mesh", described.mesh},
                   {"vertices", body.vertices.size()},
                   {"tets", body.tets.size()},
                   {"pinned", pinned},
                   {"model", described.physics.material.model},
                   {"density", described.physics.density},
                   {"surface", described.surface.mesh},
                   {"triangles", triangles}});
    add_behaviour(report, described.physics, body.tets, at_rest, all.back());
    add_ranges(report, inputs[i], all.back());
  }
  report.add_json("bodies", all);
}

void add_time(Report& report, const sim::TimeSettings& time) {
  const double seconds = (time.frames - 1) / time.fps;
  report.add("time",
             fmt::format("{} frame{} at {} 1/s, {} s; {}, {} step{} a frame", count_text(time.frames),
                         time.frames == 1 ? "" : "s", time.fps, number_text(seconds), time.integrator,
                         time.substeps, time.substeps == 1 ? "" : "s"),
             "time",
             {{"frames", time.frames},
              {"fps", time.fps},
              {"seconds", seconds},
              {"integrator", time.integrator},
              {"substeps", time.substeps}});
}

/// What makes the camera another one than it says of itself.
std::string moves_text(const CameraDesc& c) {
  std::string text;
  if (c.view != "none") text.append("; view ").append(c.view);
  if (c.frame != "none") text.append("; aimed at the bodies' box: ").append(c.frame);
  if (c.follow != "none") text += "; follows the centre of mass";
  if (c.turntable.turns || c.turntable.period) text += "; on a turntable";
  if (!c.key.empty()) text += fmt::format("; {} keys", c.key.size());
  return text;
}

void add_pictures(Report& report, const SceneDesc& scene) {
  const render::CameraSettings& camera = scene.camera;
  const std::string projection = camera.orthographic
                                     ? fmt::format("orthographic, {} m high", *camera.orthographic)
                                     : fmt::format("perspective, {} degrees high", camera.fov);
  report.add_text("camera",
                  fmt::format("{}, from {} to {}{}", projection, point_text(camera.position.cast<double>()),
                              point_text(camera.look_at.cast<double>()), moves_text(scene.camera)));
  if (!scene.panel.empty()) report.add_text("panels", fmt::format("{} in each picture", scene.panel.size()));
  const render::RenderSettings& r = scene.render;
  std::string how = fmt::format("{} x {} by {}", r.width, r.height, r.backend);
  if (r.backend == "path") how += fmt::format(", {} paths a pixel", r.samples);
  for (const std::string& channel : r.channels) how += ", and " + channel;
  report.add("pictures", how, "pictures",
             {{"width", r.width}, {"height", r.height}, {"backend", r.backend}, {"channels", r.channels}});
}

void add_disk(Report& report, const SceneDesc& scene, const sim::Model& model) {
  std::vector<FrameJob> jobs;
  jobs.reserve(static_cast<std::size_t>(scene.time.frames));
  for (int frame = 0; frame < scene.time.frames; ++frame) {
    jobs.push_back({.frame = frame, .simulate = true, .draw = true});
  }
  const int levels = 1 + sim::make_integrator(scene.time, scene.solver, model)->history_levels();
  const std::size_t bytes = expected_size(jobs, model.mesh().vertex_count(), levels, scene.render).estimate;
  report.add("on disk", "about " + size_text(bytes), "expected_bytes", bytes);
}

}  // namespace

Report scene_info(const fs::path& file, const std::vector<std::string>& overrides) {
  const SceneDesc scene = load_scene(file, overrides);
  Progress quiet(true);
  const std::vector<sim::BodyInput> inputs = read_bodies(scene, quiet);
  const sim::Model model(inputs, scene.time.gravity);
  const std::vector<sim::Surface> surfaces = build_surfaces(scene, model, quiet);

  Report report(fmt::format("{}: scene '{}'", file.string(), scene.name), "scene", file.string());
  report.add_json("name", scene.name);
  add_bodies(report, scene, inputs, model, surfaces);
  add_box(report, model.mesh().X.colwise().minCoeff(), model.mesh().X.colwise().maxCoeff());
  report.add("mass", number_text(model.total_mass()) + " kg", "mass", model.total_mass());
  report.add("unknowns", count_text(model.pins().free_dofs()) + " free coordinates", "unknowns",
             model.pins().free_dofs());
  add_time(report, scene.time);
  add_pictures(report, scene);
  add_disk(report, scene, model);
  return report;
}

}  // namespace lagomorph::apps
