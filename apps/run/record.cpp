#include "apps/run/record.h"

#include <array>
#include <cstdint>
#include <limits>
#include <system_error>

#include <nlohmann/json.hpp>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/run/solves_text.h"
#include "sim/error.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

sim::Vec3 vector_of(const Json& json) {
  const auto v = json.get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}
/// Zero where it is not told.
sim::Vec3 vector_of(const Json& json, const char* key) {
  return json.contains(key) ? vector_of(json.at(key)) : sim::Vec3(sim::Vec3::Zero());
}
Json json_of(const sim::Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// A number that is not finite is null in JSON.
double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

/// Zero where they are not told.
sim::SolveCounts solves_from(const Json& json) {
  const auto count = [&](const char* key) { return json.value(key, std::int64_t{0}); };
  return {count("factorizations"), count("cg_iterations"), count("factor_iterations")};
}

Json newton_json(const std::vector<sim::NewtonLog>& logs) {
  Json json = Json::array();
  for (const sim::NewtonLog& log : logs) {
    Json iterates = Json::array();
    for (const sim::NewtonIterate& at : log.iterates)
      iterates.push_back({at.residual, at.energy, at.step, at.clamping});
    json.push_back({{"time", log.t},
                    {"h", log.h},
                    {"status", sim::to_string(log.status)},
                    {"iterates", std::move(iterates)}});
  }
  return json;
}

std::vector<sim::NewtonLog> newton_from(const Json& json) {
  std::vector<sim::NewtonLog> logs;
  for (const Json& step : json) {
    sim::NewtonLog& log = logs.emplace_back();
    log.t = step.at("time").get<double>();
    log.h = step.at("h").get<double>();
    log.status = sim::step_status(step.at("status").get<std::string>());
    for (const Json& at : step.at("iterates"))
      log.iterates.push_back({number(at.at(0)), number(at.at(1)), number(at.at(2)), number(at.at(3))});
  }
  return logs;
}

FrameRecord from_json(const Json& json) {
  FrameRecord record;
  record.frame = json.at("frame").get<int>();
  const Json& seconds = json.at("seconds");
  if (json.contains("state_sha256")) {
    StateRecord& state = record.state.emplace();
    state.sha256 = json.at("state_sha256").get<std::string>();
    state.made_by = json.at("state_made_by").get<std::string>();
    state.time = json.at("time").get<double>();
    if (json.contains("history_times"))
      state.history_times = json.at("history_times").get<std::vector<double>>();
    const Json& energy = json.at("energy");
    state.energy = {energy.at("kinetic").get<double>(), energy.at("elastic").get<double>(),
                    energy.at("gravitational").get<double>()};
    state.mass = json.at("mass").get<double>();
    state.momentum = vector_of(json.at("momentum"));
    state.angular_momentum = vector_of(json, "angular_momentum");
    state.min_J = json.value("min_J", 1.0);
    state.report.work_pins = json.value("work_pins", 0.0);
    state.report.work_loads = json.value("work_loads", 0.0);
    for (const Json& force : json.value("pin_forces", Json::array()))
      state.report.pin_forces.push_back(vector_of(force));
    state.report.steps = json.at("steps").get<int>();
    state.report.rejected = json.value("rejected", 0);
    state.report.halvings = json.at("halvings").get<int>();
    state.report.newton_iterations = json.at("newton_iterations").get<int>();
    state.report.solves = solves_from(json.value("solves", Json::object()));
    state.report.residual = json.at("residual").get<double>();
    state.report.damping_loss = json.value("damping_loss", 0.0);
    state.report.error = json.value("error", 0.0);
    state.report.hit_rounding_floor = json.at("hit_rounding_floor").get<bool>();
    if (json.contains("newton")) state.report.newton = newton_from(json["newton"]);
    state.seconds = seconds.at("simulation").get<double>();
  }
  if (json.contains("picture_sha256")) {
    PictureRecord& picture = record.picture.emplace();
    picture.sha256 = json.at("picture_sha256").get<std::string>();
    picture.made_by = json.at("picture_made_by").get<std::string>();
    picture.of_state = json.at("picture_of_state").get<std::string>();
    picture.channels = json.at("channels").get<std::map<std::string, std::string>>();
    picture.clamp = json.value("clamp", 0.0);
    if (json.contains("ranges"))
      picture.ranges = json["ranges"].get<std::map<std::string, std::array<double, 2>>>();
    if (json.contains("fitted_box")) picture.fitted_box = json["fitted_box"].get<std::array<double, 6>>();
    picture.rendering_seconds = seconds.at("rendering").get<double>();
    picture.writing_seconds = seconds.at("writing").get<double>();
  }
  return record;
}

}  // namespace

Json to_json(const FrameRecord& record) {
  Json json = {{"frame", record.frame}};
  Json seconds = Json::object();
  if (record.state) {
    const StateRecord& state = *record.state;
    json["time"] = state.time;
    if (!state.history_times.empty()) json["history_times"] = state.history_times;
    json["state_sha256"] = state.sha256;
    json["state_made_by"] = state.made_by;
    json["steps"] = state.report.steps;
    json["rejected"] = state.report.rejected;
    json["halvings"] = state.report.halvings;
    json["newton_iterations"] = state.report.newton_iterations;
    json["solves"] = solves_json(state.report.solves);
    json["residual"] = state.report.residual;
    json["damping_loss"] = state.report.damping_loss;
    json["error"] = state.report.error;
    json["hit_rounding_floor"] = state.report.hit_rounding_floor;
    if (!state.report.newton.empty()) json["newton"] = newton_json(state.report.newton);
    json["energy"] = {{"kinetic", state.energy.kinetic},
                      {"elastic", state.energy.elastic},
                      {"gravitational", state.energy.gravitational}};
    json["mass"] = state.mass;
    json["momentum"] = json_of(state.momentum);
    json["angular_momentum"] = json_of(state.angular_momentum);
    json["min_J"] = state.min_J;
    json["work_pins"] = state.report.work_pins;
    json["work_loads"] = state.report.work_loads;
    json["pin_forces"] = Json::array();
    for (const sim::Vec3& force : state.report.pin_forces) json["pin_forces"].push_back(json_of(force));
    seconds["simulation"] = state.seconds;
  }
  if (record.picture) {
    const PictureRecord& picture = *record.picture;
    json["picture_sha256"] = picture.sha256;
    json["picture_made_by"] = picture.made_by;
    json["picture_of_state"] = picture.of_state;
    json["channels"] = picture.channels;
    if (picture.clamp > 0.0) json["clamp"] = picture.clamp;
    if (!picture.ranges.empty()) json["ranges"] = picture.ranges;
    if (picture.fitted_box) json["fitted_box"] = *picture.fitted_box;
    seconds["rendering"] = picture.rendering_seconds;
    seconds["writing"] = picture.writing_seconds;
  }
  json["seconds"] = std::move(seconds);
  return json;
}

void write_record(const RunPaths& paths, const FrameRecord& record) {
  write_file(paths.record(record.frame), to_json(record).dump(1) + "\n");
}

std::optional<FrameRecord> read_record(const RunPaths& paths, int frame) {
  try {
    FrameRecord record = from_json(Json::parse(read_file(paths.record(frame))));
    if (record.frame == frame) return record;
  } catch (const Json::exception&) {
    // of another version, or damaged
  } catch (const sim::InputError&) {
    // likewise
  } catch (const Error&) {
    // unreadable
  }
  return std::nullopt;
}

std::map<int, FrameRecord> read_records(const RunPaths& paths) {
  std::map<int, FrameRecord> records;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(paths.records(), error)) {
    const std::optional<int> frame = frame_of(entry.path(), ".json");
    if (!frame) continue;
    if (std::optional<FrameRecord> record = read_record(paths, *frame))
      records.emplace(*frame, std::move(*record));
  }
  return records;
}

std::map<int, FrameRecord> read_gathered_records(const RunPaths& paths) {
  std::map<int, FrameRecord> records;
  try {
    const Json json = Json::parse(read_file(paths.run_json()));
    for (const Json& frame : json.at("frames")) {
      FrameRecord record = from_json(frame);
      records.insert_or_assign(record.frame, std::move(record));
    }
  } catch (const Json::exception&) {
    records.clear();
  } catch (const Error&) {
    records.clear();
  }
  return records;
}

}  // namespace lagomorph::apps
