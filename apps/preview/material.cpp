#include "apps/preview/material.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/frame_ranges.h"
#include "apps/run/paths.h"
#include "apps/shell.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void read_scene_of(PreviewMaterial& m, const RunPaths& paths) {
  try {
    const Json& time = m.info->about.at("scene").at("time");
    m.name = m.info->about.at("name").get<std::string>();
    m.scene_frames = time.at("frames").get<int>();
    m.fps = time.at("fps").get<double>();
    m.integrator = time.at("integrator").get<std::string>();
  } catch (const Json::exception& e) {
    wrong_input(fmt::format("{}: is not a run's run.json ({})", paths.run_json().string(), e.what()));
  }
  std::error_code none;
  if (fs::exists(paths.scene(), none)) m.scene = read_file(paths.scene());
}

/// The records, or what run.json tells of them where a download left them out.
std::map<int, FrameRecord> records_of(const RunPaths& paths) {
  std::map<int, FrameRecord> records = read_records(paths);
  if (records.empty()) records = read_gathered_records(paths);
  std::erase_if(records, [](const auto& r) { return !r.second.state; });
  return records;
}

/// The name of a folder, whatever its path ends with.
std::string folder_name(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  return name.empty() ? "pictures" : name;
}

void keep_only(PreviewMaterial& m, const FrameRange& range) {
  if (m.info && range.last >= m.scene_frames) {
    wrong_input(fmt::format("--frames {}..{}: the scene's last frame is {}", range.first, range.last,
                            m.scene_frames - 1));
  }
  const auto is_outside = [&](const auto& frame) {
    return frame.first < range.first || frame.first > range.last;
  };
  std::erase_if(m.pictures, is_outside);
  std::erase_if(m.records, is_outside);
}

void refuse_nothing(const PreviewMaterial& m, const std::optional<FrameRange>& frames) {
  if (!m.pictures.empty() || !m.records.empty()) return;
  const std::string of = frames ? fmt::format(" of frames {}..{}", frames->first, frames->last) : "";
  wrong_input(m.info
                  ? fmt::format("{}: has no frame{} to show; `lagomorph run` makes them", m.run.string(), of)
                  : fmt::format("{}: has no numbered PNG file{} to show", m.run.string(), of));
}

void remark_gaps(PreviewMaterial& m) {
  if (m.pictures.empty()) {
    m.remarks.push_back("there are no pictures; this draws them: lagomorph render " +
                        shell_word(m.run.string()));
    return;
  }
  std::vector<int> missing;
  const int first = m.pictures.begin()->first, last = m.pictures.rbegin()->first;
  // Numbers far apart (dates, say) are no gaps to list one by one.
  if (last - first > 10 * static_cast<int>(m.pictures.size()) + 1000) return;
  for (int frame = first; frame <= last; ++frame) {
    if (!m.pictures.contains(frame)) missing.push_back(frame);
  }
  if (missing.empty()) return;
  m.remarks.push_back(fmt::format("{} missing between the first and the last: {}",
                                  missing.size() == 1 ? "a picture is" : "pictures are",
                                  ranges_text(missing)));
}

}  // namespace

PreviewMaterial read_material(const fs::path& run, const std::optional<FrameRange>& frames) {
  PictureFolder folder = list_pictures(run, "run");
  PreviewMaterial m;
  m.run = run;
  m.name = folder_name(run);
  m.info = read_run_info(RunPaths(run));
  m.pictures = std::move(folder.pictures);
  if (m.info) {
    read_scene_of(m, RunPaths(run));
    m.records = records_of(RunPaths(run));
  }
  if (frames) keep_only(m, *frames);
  refuse_nothing(m, frames);
  remark_gaps(m);
  if (!folder.unnumbered.empty() && !m.info) {
    m.remarks.push_back(fmt::format(
        "{} without a number in {} left out",
        folder.unnumbered.size() == 1 ? "a PNG file" : fmt::format("{} PNG files", folder.unnumbered.size()),
        folder.unnumbered.size() == 1 ? "its name is" : "their names are"));
  }
  return m;
}

double picture_rate(const PreviewMaterial& m) {
  if (!m.info || m.pictures.size() < 2) return m.fps;
  const std::vector<int> frames = frame_numbers(m.pictures);
  std::vector<int> steps;
  for (std::size_t i = 1; i < frames.size(); ++i) steps.push_back(frames[i] - frames[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());  // a picture that is missing is no slower pace
  return m.fps / *middle;
}

}  // namespace lagomorph::apps
