#include "apps/preview/story.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/frame_ranges.h"
#include "apps/progress/progress.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string counted(std::size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string seconds_text(double seconds) {
  if (seconds >= 60) return duration_text(seconds);
  if (seconds >= 0.95) return fmt::format("{:.1f} s", seconds);
  return seconds >= 0.0995 ? fmt::format("{:.2f} s", seconds) : fmt::format("{:.3g} ms", 1000 * seconds);
}

/// Frames whose record says so.
std::vector<int> frames_where(const PreviewMaterial& m, const auto& says) {
  std::vector<int> frames;
  for (const auto& [frame, record] : m.records) {
    if (says(record.state->report)) frames.push_back(frame);
  }
  return frames;
}

bool was_halved(const sim::FrameReport& r) { return r.halvings > 0; }
bool hit_the_floor(const sim::FrameReport& r) { return r.hit_rounding_floor; }

bool has_steps(const PreviewMaterial& m) { return !m.records.empty() && m.records.rbegin()->first > 0; }

std::string steps_text(const PreviewMaterial& m) {
  if (!has_steps(m)) return m.records.empty() ? "" : "the initial state";
  if (m.integrator == "symplectic_euler") return "stepped explicitly";
  if (m.integrator == "linearly_implicit_euler") return "one linear solve a step";
  const std::size_t halved = frames_where(m, was_halved).size();
  return "all steps converged" +
         (halved > 0 ? fmt::format(", in {} after halving", counted(halved, "frame")) : "");
}

void add_energies(const PreviewMaterial& m, Facts& facts) {
  if (m.records.empty()) return;
  const sim::Energies& first = m.records.begin()->second.state->energy;
  const sim::Energies& last = m.records.rbegin()->second.state->energy;
  double kinetic = 0, elastic = 0;
  for (const auto& [frame, record] : m.records) {
    kinetic = std::max(kinetic, record.state->energy.kinetic);
    elastic = std::max(elastic, record.state->energy.elastic);
  }
  facts.emplace_back(
      "energy", fmt::format("total {:.5g} J to {:.5g} J ({:+.3g} J); at most {:.4g} J kinetic, "
                            "{:.4g} J elastic",
                            first.total(), last.total(), last.total() - first.total(), kinetic, elastic));
}

void add_steps(const PreviewMaterial& m, Facts& facts) {
  if (!has_steps(m)) return;
  int iterations = 0, steps = 0;
  double residual = 0;
  for (const auto& [frame, record] : m.records) {
    iterations += record.state->report.newton_iterations;
    steps += record.state->report.steps;
    residual = std::max(residual, record.state->report.residual);
  }
  const auto frames = static_cast<double>(m.records.size() - (m.records.begin()->first == 0 ? 1 : 0));
  std::string text = fmt::format("{}: {}", m.integrator, steps_text(m));
  if (iterations > 0) {
    text += fmt::format("; {:.1f} Newton iterations a frame in {:.1f} steps, largest residual {:.1e}",
                        iterations / frames, steps / frames, residual);
  }
  facts.emplace_back("steps", text);
  if (const std::vector<int> halved = frames_where(m, was_halved); !halved.empty())
    facts.emplace_back("halved steps", "frames " + ranges_text(halved));
  if (const std::vector<int> floor = frames_where(m, hit_the_floor); !floor.empty())
    facts.emplace_back("stopped at rounding", "frames " + ranges_text(floor));
}

void add_seconds(const PreviewMaterial& m, Facts& facts) {
  if (m.records.empty()) return;
  const FrameSeconds mean = mean_frame_seconds(m);
  std::string text = seconds_text(mean.simulation) + " simulation";
  if (mean.rendering + mean.writing > 0) {
    text +=
        fmt::format(", {} rendering, {} writing", seconds_text(mean.rendering), seconds_text(mean.writing));
  }
  facts.emplace_back("time a frame", text);
}

std::string frames_text(const PreviewMaterial& m) {
  const std::vector<int> drawn = frame_numbers(m.pictures), simulated = frame_numbers(m.records);
  const auto of = [&](const std::vector<int>& frames) {
    return fmt::format("{}: {}",
                       m.scene_frames > 0 ? fmt::format("{} of {}", frames.size(), m.scene_frames)
                                          : std::to_string(frames.size()),
                       ranges_text(frames));
  };
  if (drawn.empty()) return of(simulated) + ", not drawn";
  if (m.info && drawn != simulated) return fmt::format("{}; simulated {}", of(drawn), of(simulated));
  return of(drawn);
}

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

}  // namespace

double frame_time(const PreviewMaterial& m, int frame) {
  const auto record = m.records.find(frame);
  return record != m.records.end() ? record->second.state->time : frame / m.fps;
}

FrameSeconds mean_frame_seconds(const PreviewMaterial& m) {
  FrameSeconds sum;
  int steps = 0, pictures = 0;
  for (const auto& [frame, record] : m.records) {
    if (frame > 0) sum.simulation += record.state->seconds, ++steps;
    if (!record.picture) continue;
    sum.rendering += record.picture->rendering_seconds;
    sum.writing += record.picture->writing_seconds;
    ++pictures;
  }
  sum.simulation /= std::max(1, steps);
  sum.rendering /= std::max(1, pictures);
  sum.writing /= std::max(1, pictures);
  return sum;
}

std::string headline(const PreviewMaterial& m) {
  const std::size_t n = m.pictures.empty() ? m.records.size() : m.pictures.size();
  if (!m.info)
    return fmt::format("{}: {}, not made by Lagomorph, so without energies", m.name, counted(n, "picture"));
  const bool is_part = static_cast<int>(n) < m.scene_frames;
  std::string text = fmt::format(
      "{}: {}", m.name,
      is_part ? fmt::format("{} of {}", n, counted(static_cast<std::size_t>(m.scene_frames), "frame"))
              : counted(n, "frame"));
  const double rate = picture_rate(m);
  if (n > 1) text += fmt::format(", {} at {:.4g} fps", seconds_text(static_cast<double>(n) / rate), rate);
  if (m.pictures.empty()) text += ", not drawn";
  if (const std::string steps = steps_text(m); !steps.empty()) text += ", " + steps;
  return text;
}

Facts run_facts(const PreviewMaterial& m, const Shown& shown) {
  Facts facts = {{"frames", frames_text(m)}};
  if (m.info && m.pictures.size() + m.records.size() > 0) {
    facts.emplace_back("rate", fmt::format("{:.4g} frames a second", picture_rate(m)));
  }
  if (shown.picture.width > 0)
    facts.emplace_back("size", fmt::format("{} x {} pixels", shown.picture.width, shown.picture.height));
  if (m.info && m.info->about.contains("mesh") && m.info->about["mesh"].is_object()) {
    const Json& mesh = m.info->about["mesh"];
    if (mesh.contains("vertices") && mesh.contains("tets"))
      facts.emplace_back(
          "mesh", fmt::format("{} vertices, {} tets", text_of(mesh["vertices"]), text_of(mesh["tets"])));
  }
  add_steps(m, facts);
  add_energies(m, facts);
  add_seconds(m, facts);
  return facts;
}

Facts environment_facts(const PreviewMaterial& m) {
  Facts facts;
  if (!m.info) return facts;
  const Json& about = m.info->about;
  if (about.contains("lagomorph")) facts.emplace_back("lagomorph", text_of(about["lagomorph"]));
  for (const char* part : {"machine", "dependencies"}) {
    if (!about.contains(part) || !about[part].is_object()) continue;
    for (const auto& [key, value] : about[part].items()) {
      std::string label = key;
      std::replace(label.begin(), label.end(), '_', ' ');
      facts.emplace_back(label, text_of(value));
    }
  }
  return facts;
}

}  // namespace lagomorph::apps
