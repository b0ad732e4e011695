#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/approve/approve.h"
#include "apps/check/golden_file.h"
#include "apps/check/hashes.h"
#include "apps/check/light_statistics.h"
#include "apps/file_io.h"
#include "apps/hash.h"
#include "apps/run/lock.h"
#include "apps/run/paths.h"
#include "render/channels.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string first_golden_toml(const ApproveRequest& request) {
  std::string text =
      "# What pictures of this golden may differ by; see \"Golden-image checks\" in Lagomorph's README.\n"
      "preset = \"render\"\n";
  if (request.states_every) text += fmt::format("states_every = {}\n", *request.states_every);
  return text;
}

/// The channels that a golden has use for: statistics are small, body ids are where a mask asks for them.
std::vector<const char*> channels_of(const fs::path& golden) {
  std::vector<const char*> channels = {render::statistics_channel};
  const GoldenFile file = read_golden_file(golden, {}, std::nullopt);
  if (std::any_of(file.masks.begin(), file.masks.end(), [](const MaskRule& m) { return m.body_id; }))
    channels.push_back(render::body_id_channel);
  return channels;
}

/// What lies beside the picture goes with it; of a picture that is not kept, or has none, none stays.
void keep_channel(const AcceptedFrame& frame, const char* channel) {
  const fs::path from = channel_beside(frame.from, channel);
  const fs::path to = channel_beside(frame.to, channel);
  if (frame.only_hash || !is_there(from)) {
    if (is_there(to)) remove_file(to);
    return;
  }
  make_folder(to.parent_path());
  write_file_if_changed(to, read_file(from), Durable::yes);
}

void keep_picture(const AcceptedFrame& frame, std::map<int, PictureHash>& hashes) {
  const std::string bytes = read_file(frame.from);
  if (frame.only_hash) {
    hashes[frame.frame] = {sha256(bytes), pixels_sha256(render::read_png(bytes, frame.from.string()))};
    remove_file(frame.to);
    return;
  }
  make_folder(frame.to.parent_path());
  write_file_if_changed(frame.to, bytes, Durable::yes);
}

/// The state beside the picture that shows it; an older one of another picture would mislead.
void keep_state(const AcceptedFrame& frame, const fs::path& root) {
  const fs::path to = RunPaths(root).state(frame.frame);
  if (frame.state.empty()) {
    if (is_there(to)) remove_file(to);
    return;
  }
  make_folder(to.parent_path());
  write_file_if_changed(to, read_file(frame.state), Durable::yes);
}

/// What run.json tells of the golden's frames: of those accepted what RUN's tells, of the others what was
/// told. What it says of the whole run is RUN's when all of its frames are golden now.
void keep_run_json(const fs::path& from, const fs::path& to, const Approval& approval, bool whole) {
  if (!is_there(from)) return;
  try {
    Json fresh = Json::parse(read_file(from));
    if (is_there(to)) {
      const Json old = Json::parse(read_file(to));
      std::map<int, Json> frames;
      for (const Json& frame : old.at("frames")) frames[frame.at("frame").get<int>()] = frame;
      for (const Json& frame : fresh.at("frames")) {
        const int number = frame.at("frame").get<int>();
        for (const AcceptedFrame& accepted : approval.accepted) {
          if (accepted.frame == number) frames[number] = frame;
        }
      }
      if (!whole) fresh = old;
      fresh["frames"] = Json::array();
      for (auto& [number, frame] : frames) fresh["frames"].push_back(std::move(frame));
    }
    write_file_if_changed(to, fresh.dump(1) + "\n", Durable::yes);
  } catch (const Json::exception&) {
    // What is no run.json of ours tells nothing of the golden either.
  }
}

}  // namespace

void carry_out(const ApproveRequest& request, const Approval& approval) {
  if (approval.accepted.empty()) return;
  make_folder(request.golden);
  RunLock lock(request.golden);
  lock.take(RunLock::Kind::exclusive);
  std::map<int, PictureHash> hashes = read_hashes(request.golden);
  const std::vector<const char*> channels = channels_of(request.golden);
  for (const AcceptedFrame& frame : approval.accepted) {
    for (const char* channel : channels) keep_channel(frame, channel);
    keep_picture(frame, hashes);
    if (!frame.only_hash && !request.variant) hashes.erase(frame.frame);
  }
  write_hashes(request.golden, hashes);
  if (!is_there(request.golden / "golden.toml"))
    write_file(request.golden / "golden.toml", first_golden_toml(request), Durable::yes);
  const fs::path root = request.variant ? request.golden / "variants" / *request.variant : request.golden;
  for (const AcceptedFrame& frame : approval.accepted) keep_state(frame, root);
  const bool whole = !request.frames && !request.report;
  keep_run_json(request.run / "run.json", root / "run.json", approval, whole);
}

}  // namespace lagomorph::apps
