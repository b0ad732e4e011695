#include "apps/check/causes.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/one_line.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string listed(const std::vector<std::string>& differences) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(differences.size(), most); ++i)
    text += (text.empty() ? "" : "; ") + differences[i];
  if (differences.size() > most) text += fmt::format("; and {} more", differences.size() - most);
  return one_line(text);
}

std::string value_text(const Json& about, const char* part, const std::string& key) {
  const Json* at = &about;
  for (const std::string& step : {std::string(part), key}) {
    if (step.empty()) continue;
    if (!at->is_object() || !at->contains(step)) return "(not told)";
    at = &(*at)[step];
  }
  return at->is_string() ? at->get<std::string>() : at->dump();
}

/// "cholmod 3.0.14 -> 3.0.15" of each key of about[part] that differs.
void add_part(const RunStory& golden, const RunStory& run, const char* part,
              std::vector<std::string>& differences) {
  std::vector<std::string> keys;
  for (const RunStory* story : {&golden, &run}) {
    const auto at = story->info.about.find(part);
    if (at == story->info.about.end() || !at->is_object()) continue;
    for (const auto& [key, value] : at->items()) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  for (const std::string& key : keys) {
    const std::string there = value_text(golden.info.about, part, key);
    const std::string here = value_text(run.info.about, part, key);
    if (there != here) differences.push_back(fmt::format("{} {} -> {}", key, there, here));
  }
}

std::optional<Cause> scene_cause(const RunStory& run, const RunStory& golden) {
  const Identity &there = golden.info.identity, &here = run.info.identity;
  const std::vector<std::string> simulation = key_differences(there.simulation(), here.simulation());
  std::vector<std::string> all = simulation;
  for (std::string& line : key_differences(there.picture(), here.picture())) all.push_back(std::move(line));
  if (all.empty()) return std::nullopt;
  const char* reach = simulation.empty() ? "only pictures depend on" : "the simulation depends on";
  return Cause{"scene", fmt::format("{} differ{} from the golden's, which {}: {}",
                                    all.size() == 1 ? "1 key" : fmt::format("{} keys", all.size()),
                                    all.size() == 1 ? "s" : "", reach, listed(all))};
}

/// One key of the build, a hash, as what it stands for.
bool differs(const std::vector<ResolvedKey>& there, const std::vector<ResolvedKey>& here,
             const std::string& key) {
  const auto value = [&](const std::vector<ResolvedKey>& keys) {
    for (const ResolvedKey& k : keys) {
      if (k.key == key) return k.value;
    }
    return std::string();
  };
  return value(there) != value(here);
}

std::optional<Cause> build_cause(const RunStory& run, const RunStory& golden) {
  std::vector<std::string> all;
  const std::string there = value_text(golden.info.about, "lagomorph", "");
  const std::string here = value_text(run.info.about, "lagomorph", "");
  const Identity &old = golden.info.identity, &now = run.info.identity;
  if (there != here) {
    all.push_back(fmt::format("lagomorph {} -> {}", there, here));
  } else if (differs(old.simulation_build(), now.simulation_build(), "build.simulation")) {
    all.push_back(fmt::format("another build of lagomorph {}, of other sources for the simulation", here));
  } else if (differs(old.picture_build(), now.picture_build(), "build.program")) {
    all.push_back(fmt::format("another build of lagomorph {}, of the same simulation", here));
  }
  add_part(golden, run, "dependencies", all);
  if (all.empty()) return std::nullopt;
  return Cause{"build", listed(all)};
}

std::optional<Cause> machine_cause(const RunStory& run, const RunStory& golden) {
  std::vector<std::string> all;
  add_part(golden, run, "machine", all);
  if (all.empty()) return std::nullopt;
  std::string text = listed(all);
  const bool harmless = std::all_of(all.begin(), all.end(), [](const std::string& line) {
    return line.starts_with("threads ") || line.starts_with("cores ");
  });
  if (harmless) text += " (no byte should depend on it)";
  return Cause{"machine", text};
}

/// Whether the scene and the build that the golden's run.json tells are those of a failing frame's picture:
/// others may have been approved since, from another run.
bool tells_of(const RunStory& golden, const std::vector<FrameResult>& frames) {
  const std::string& told = golden.picture_hash;
  return std::any_of(frames.begin(), frames.end(), [&](const FrameResult& frame) {
    if (frame.passed()) return false;
    const FrameStory* story = golden.of(frame.frame);
    return story == nullptr || story->picture_made_by.empty() || story->picture_made_by == told;
  });
}

}  // namespace

std::vector<Cause> find_causes(const RunStory& run, const RunStory& golden,
                               const std::vector<FrameResult>& frames) {
  std::vector<Cause> causes;
  const auto add = [&](std::optional<Cause> cause) {
    if (cause) causes.push_back(*std::move(cause));
  };
  if (tells_of(golden, frames)) {
    add(scene_cause(run, golden));
    add(build_cause(run, golden));
    add(machine_cause(run, golden));
  }
  add(simulation_cause(run, golden));
  add(renderer_cause(run, golden, frames));
  return causes;
}

}  // namespace lagomorph::apps
