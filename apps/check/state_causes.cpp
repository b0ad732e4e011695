#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/check/causes.h"
#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/frame_ranges.h"
#include "apps/npy.h"

namespace lagomorph::apps {
namespace {

/// "vertex 812 of body 'bunny'": vertices are numbered per body, as in the scene's pins.
std::string vertex_text(const nlohmann::ordered_json& about, std::size_t vertex) {
  try {
    for (const auto& body : about.at("mesh").at("bodies")) {
      const std::size_t count = body.at("vertices").get<std::size_t>();
      if (vertex < count)
        return fmt::format("vertex {} of body '{}'", vertex, body.at("name").get<std::string>());
      vertex -= count;
    }
  } catch (const nlohmann::json::exception&) {
    // Older run.json: the number alone.
  }
  return fmt::format("vertex {}", vertex);
}

struct Moved {
  int frame = -1;
  std::size_t vertex = 0;
  double distance = -1;  // [m]
};

/// The vertex whose positions of level 0 are the furthest apart; nullopt where one of both keeps no state, or
/// the meshes have other counts.
std::optional<Moved> moved_most(const RunStory& run, const RunStory& golden, int frame) {
  const auto read = [&](const RunStory& story) -> std::optional<NpyArray> {
    const std::filesystem::path file = story.paths.state(frame);
    std::error_code none;
    if (!std::filesystem::exists(file, none)) return std::nullopt;
    try {
      NpyArray array = read_npy(read_file(file), file.string());
      if (array.shape.size() == 4 && array.shape[1] == 2 && array.shape[3] == 3) return array;
    } catch (const Error& error) {
      if (error.status != ExitStatus::wrong_input) throw;
    }
    return std::nullopt;
  };
  const std::optional<NpyArray> there = read(golden);
  if (!there) return std::nullopt;
  const std::optional<NpyArray> here = read(run);
  if (!here || here->shape[2] != there->shape[2]) return std::nullopt;
  Moved most{.frame = frame};
  for (std::size_t v = 0; v < here->shape[2]; ++v) {
    const double* a = &there->values[3 * v];
    const double* b = &here->values[3 * v];
    const double distance = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    if (distance > most.distance) most = {frame, v, distance};
  }
  return most;
}

struct Parted {
  int frame = -1;
  std::size_t kind = 0;
  double there = 0, here = 0;  // [J]
};

/// The energy that differs most. Gravity's has no natural zero, so that differences, not ratios, are
/// compared.
std::optional<Parted> parted_most(const RunStory& run, const RunStory& golden, std::span<const int> frames) {
  std::optional<Parted> most;
  for (const int frame : frames) {
    const FrameStory *there = golden.of(frame), *here = run.of(frame);
    if (!there->energy || !here->energy) continue;
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const double a = (*there->energy)[kind], b = (*here->energy)[kind];
      if (!most || std::abs(b - a) > std::abs(most->here - most->there)) most = {frame, kind, a, b};
    }
  }
  return most;
}

std::string movement_text(const RunStory& run, const RunStory& golden, std::span<const int> differing) {
  std::optional<Moved> most;
  int compared = 0;
  for (const int frame : differing) {
    const std::optional<Moved> moved = moved_most(run, golden, frame);
    if (!moved) continue;
    ++compared;
    if (!most || moved->distance > most->distance) most = moved;
  }
  if (!most) return "; the golden keeps no states, which would tell how far vertices moved";
  return fmt::format(
      "; {} is the furthest from the golden's place, by {:.3g} m in frame {} ({} of both sides compared)",
      vertex_text(run.info.about, most->vertex), most->distance, most->frame,
      compared == 1 ? "1 state" : fmt::format("{} states", compared));
}

}  // namespace

std::optional<Cause> simulation_cause(const RunStory& run, const RunStory& golden) {
  std::vector<int> differing;
  int both = 0;
  for (const auto& [frame, there] : golden.frames) {
    const FrameStory* here = run.of(frame);
    if (here == nullptr || here->state.empty() || there.state.empty()) continue;
    ++both;
    if (here->state != there.state) differing.push_back(frame);
  }
  if (differing.empty()) return std::nullopt;
  std::string text =
      fmt::format("states differ from frame {} on, {} of {}", differing.front(), differing.size(), both);
  text += movement_text(run, golden, differing);
  if (const std::optional<Parted> most = parted_most(run, golden, differing)) {
    constexpr std::array names = {"kinetic", "elastic", "gravitational"};
    text += fmt::format("; energies part most in frame {}, {} {:.6g} -> {:.6g} J", most->frame,
                        names[most->kind], most->there, most->here);
  }
  return Cause{"simulation", text};
}

std::optional<Cause> renderer_cause(const RunStory& run, const RunStory& golden,
                                    const std::vector<FrameResult>& frames) {
  std::vector<int> same;
  int failing = 0;
  for (const FrameResult& frame : frames) {
    if (frame.passed() || frame.fresh.empty()) continue;
    const FrameStory *here = run.of(frame.frame), *there = golden.of(frame.frame);
    if (here == nullptr || there == nullptr || here->state_shown.empty()) continue;
    ++failing;
    if (here->state_shown == there->state_shown) same.push_back(frame.frame);
  }
  if (same.empty()) return std::nullopt;
  const bool all = static_cast<int>(same.size()) == failing;
  return Cause{
      "renderer",
      all ? "only the drawing differs: the failing frames show states that are the golden's to the bit"
          : fmt::format("frames {} differ though they show states that are the golden's to the bit",
                        ranges_text(same))};
}

}  // namespace lagomorph::apps
