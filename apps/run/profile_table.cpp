#include "apps/run/profile_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace lagomorph::apps {
namespace {

using sim::Stage;

struct Row {
  std::string name;
  double seconds = 0.0;
  std::int64_t calls = 0;
};

/// Stages of one thread, one after the other; what is not told apart is its rest.
struct Lane {
  const char* name;
  std::vector<Stage> stages;
  std::optional<Stage> whole;  // has the stages in it, and more; none: the lane is the sum of its stages
  Stage waiting;
};

const std::array<Lane, 3>& lanes() {
  static const std::array<Lane, 3> all = {
      Lane{"simulating",
           {Stage::energy, Stage::gradient, Stage::hessian, Stage::analysis, Stage::factorization,
            Stage::solve},
           Stage::simulation,
           Stage::wait_to_simulate},
      Lane{"drawing", {Stage::surface, Stage::draw, Stage::read_back}, std::nullopt, Stage::wait_to_draw},
      Lane{"writing", {Stage::overlays, Stage::encode, Stage::write}, std::nullopt, Stage::wait_to_write}};
  return all;
}

std::vector<Row> rows_of(const Lane& lane, const sim::Profile& profile) {
  std::vector<Row> rows;
  double told = 0.0;
  for (const Stage stage : lane.stages) {
    told += profile.seconds(stage);
    if (profile.calls(stage) > 0)
      rows.push_back({std::string(to_string(stage)), profile.seconds(stage), profile.calls(stage)});
  }
  if (lane.whole && profile.calls(*lane.whole) > 0)
    rows.push_back({"rest", std::max(profile.seconds(*lane.whole) - told, 0.0), profile.calls(*lane.whole)});
  if (!rows.empty()) rows.push_back({"waiting", profile.seconds(lane.waiting), profile.calls(lane.waiting)});
  return rows;
}

/// `part` of ten characters, to an eighth of one.
std::string bar(double part) {
  static const std::array<const char*, 8> eighths = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const int length = static_cast<int>(std::lround(80.0 * std::clamp(part, 0.0, 1.0)));
  std::string text;
  for (int i = 0; i < length / 8; ++i) text += "█";
  return text + eighths[static_cast<std::size_t>(length % 8)];
}

}  // namespace

nlohmann::ordered_json stage_seconds(const sim::Profile& profile) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < sim::kStages; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (profile.calls(stage) > 0) json[std::string(to_string(stage))] = profile.seconds(stage);
  }
  return json;
}

std::string profile_table(const sim::Profile& profile, double seconds) {
  std::string text = fmt::format("{:<12}{:<15}{:>10}{:>9}{:>12}{:>8}\n", "thread", "stage", "seconds",
                                 "calls", "ms a call", "share");
  for (const Lane& lane : lanes()) {
    const char* name = lane.name;
    for (const Row& row : rows_of(lane, profile)) {
      const double share = seconds > 0.0 ? row.seconds / seconds : 0.0;
      text += fmt::format("{:<12}{:<15}{:>10.3f}{:>9}{:>12.3f}{:>7.1f}%  {}\n", name, row.name, row.seconds,
                          row.calls,
                          1e3 * row.seconds / static_cast<double>(std::max<std::int64_t>(row.calls, 1)),
                          100.0 * share, bar(share));
      name = "";
    }
  }
  return text + fmt::format("{:<27}{:>10.3f}\n", "whole command", seconds);
}

}  // namespace lagomorph::apps
