#include "apps/run/contents.h"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/run/channel_files.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

/// Folders with something of a run's names in it, but not made by one, are not touched.
void refuse_foreign_folder(const RunPaths& paths) {
  std::error_code error;
  for (const fs::path& place : {paths.scene(), paths.energy(), paths.mesh(), paths.states(), paths.pictures(),
                                paths.inputs(), paths.channels()}) {
    if (!fs::exists(place, error)) continue;
    throw Error(ExitStatus::wrong_input,
                fmt::format("{}: is no run (it has no run.json), and {} is in the way; give another --out",
                            paths.root().string(), place.filename().string()));
  }
}

void remove_frames(const fs::path& folder, const FrameNames& names, std::string_view extension,
                   const auto& keep) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::optional<int> frame = names.frame_of(entry.path(), extension);
    if (frame && !keep(*frame)) remove_file(entry.path());
  }
}

std::vector<fs::path> channel_folders(const RunPaths& paths) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(paths.channels(), error)) {
    if (entry.is_directory(error)) folders.push_back(entry.path());
  }
  return folders;
}

/// Pictures of these names and their channels, but for frames to `keep` and channels that their records have.
void remove_pictures(const RunPaths& paths, const std::map<int, FrameRecord>& records, const auto& keep) {
  remove_frames(paths.pictures(), paths.names(), ".png", keep);
  for (const fs::path& folder : channel_folders(paths)) {
    const std::string channel = folder.filename().string();
    for (const std::string& file : {channel, channel + exr_extension, channel + png_extension}) {
      remove_frames(folder, paths.names(), channel_extension(file), [&](int frame) {
        return keep(frame) && records.at(frame).picture->channels.contains(file);
      });
    }
    remove_leftovers(folder);
  }
}

bool same_parts(const FrameRecord& a, const FrameRecord& b) {
  return a.state.has_value() == b.state.has_value() && a.picture.has_value() == b.picture.has_value();
}

}  // namespace

FrameRecord matching_parts(const FrameRecord& record, const Identity& wanted) {
  FrameRecord parts{.frame = record.frame, .state = {}, .picture = {}};
  if (!record.state || record.state->made_by != wanted.state_maker()) return parts;
  parts.state = record.state;
  if (record.picture && record.picture->made_by == wanted.picture_hash() &&
      record.picture->of_state == record.state->sha256) {
    parts.picture = record.picture;
  }
  return parts;
}

RunContents read_contents(const RunPaths& paths, const Identity& wanted) {
  RunContents contents;
  std::error_code error;
  if (!fs::exists(paths.root(), error)) return contents;
  if (!fs::is_directory(paths.root(), error)) {
    throw Error(ExitStatus::wrong_input, paths.root().string() + ": cannot be a run's folder: is a file");
  }
  contents.info = read_run_info(paths);
  if (!contents.info && !fs::exists(paths.records(), error)) refuse_foreign_folder(paths);
  contents.on_disk = read_records(paths);
  const bool other_names = contents.info && contents.info->names != paths.names();
  for (const auto& [frame, record] : contents.on_disk) {
    FrameRecord parts = matching_parts(record, wanted);
    if (other_names) parts.picture.reset();
    if (record.state && !parts.state) ++contents.other_states;
    if (record.picture && !parts.picture) ++contents.other_pictures;
    if (parts.state) contents.matching.emplace(frame, std::move(parts));
  }
  return contents;
}

void refuse_others(const RunPaths& paths, const RunContents& contents, const Identity& wanted) {
  if (contents.other_states + contents.other_pictures == 0) return;
  std::vector<std::string> keys = {"its run.json is missing"};
  if (contents.info) keys = differences(contents.info->identity, wanted, contents.other_pictures > 0);
  if (contents.info && contents.info->names != paths.names()) {
    keys.push_back(
        fmt::format("--pattern {} -> {}", contents.info->names.pattern(), paths.names().pattern()));
  }
  if (keys.empty()) return;
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < keys.size() && i < most; ++i) text += (i == 0 ? "" : ", ") + keys[i];
  if (keys.size() > most) text += fmt::format(" and {} more", keys.size() - most);
  throw Error(
      ExitStatus::wrong_input,
      fmt::format(
          "{}: is another run: {}; --force makes anew what does not match ({}), --out writes elsewhere",
          paths.root().string(), text,
          contents.other_states == 1     ? "1 state and its picture"
          : contents.other_states > 0    ? fmt::format("{} states and their pictures", contents.other_states)
          : contents.other_pictures == 1 ? "1 picture"
                                         : fmt::format("{} pictures", contents.other_pictures)));
}

void remove_unmatched(const RunPaths& paths, const RunContents& contents) {
  const std::map<int, FrameRecord>& matching = contents.matching;
  const auto has_state = [&](int frame) { return matching.contains(frame); };
  const auto has_picture = [&](int frame) {
    const auto record = matching.find(frame);
    return record != matching.end() && record->second.picture.has_value();
  };
  const FrameNames usual;
  remove_frames(paths.records(), usual, ".json", has_state);  // first: a file without one is made again
  for (const auto& [frame, record] : matching) {
    if (!same_parts(record, contents.on_disk.at(frame))) write_record(paths, record);
  }
  remove_frames(paths.states(), usual, ".npy", has_state);
  if (contents.info && contents.info->names != paths.names())
    remove_pictures(RunPaths(paths.root(), contents.info->names), matching, [](int) { return false; });
  remove_pictures(paths, matching, has_picture);
  for (const fs::path& folder :
       {paths.root(), paths.states(), paths.pictures(), paths.records(), paths.inputs()}) {
    remove_leftovers(folder);
  }
}

}  // namespace lagomorph::apps
