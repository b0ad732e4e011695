#include "apps/approve/prune.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "apps/check/golden_folder.h"
#include "apps/check/light_statistics.h"
#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/run/lock.h"
#include "apps/run/paths.h"
#include "render/channels.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

std::vector<StaleGolden> stale_goldens(const fs::path& run, const fs::path& golden) {
  const PictureFolder there = list_pictures(run, "run");
  if (there.pictures.empty())
    wrong_input(fmt::format("{}: has no pictures; no golden is pruned by it", there.folder.string()));
  const GoldenFolder folder = read_golden_folder(golden);
  std::vector<StaleGolden> stale;
  const auto add = [&](int frame, const fs::path& file) {
    if (!there.pictures.contains(frame)) stale.push_back({frame, file});
  };
  const auto add_states = [&](const fs::path& root) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(RunPaths(root).states(), none)) {
      if (const std::optional<int> frame = frame_of(entry.path(), ".npy")) add(*frame, entry.path());
    }
  };
  add_states(golden);
  for (const auto& [frame, picture] : folder.own.pictures) add(frame, picture);
  for (const auto& [frame, hash] : folder.hashes) add(frame, {});
  for (const auto& [name, variant] : folder.variants) {
    for (const auto& [frame, picture] : variant.pictures) add(frame, picture);
    add_states(golden / "variants" / name);
  }
  std::sort(stale.begin(), stale.end(), [](const auto& a, const auto& b) {
    return std::tie(a.frame, a.file) < std::tie(b.frame, b.file);
  });
  return stale;
}

void prune(const fs::path& golden, const std::vector<StaleGolden>& stale) {
  RunLock lock(golden);
  lock.take(RunLock::Kind::exclusive);
  std::map<int, PictureHash> hashes = read_hashes(golden);
  for (const StaleGolden& s : stale) {
    if (s.file.empty()) {
      hashes.erase(s.frame);
    } else {
      remove_file(s.file);
      for (const char* channel : {render::statistics_channel, render::body_id_channel}) {
        const fs::path file = channel_beside(s.file, channel);
        if (std::error_code none; fs::exists(file, none)) remove_file(file);
      }
    }
  }
  write_hashes(golden, hashes);
}

}  // namespace lagomorph::apps
