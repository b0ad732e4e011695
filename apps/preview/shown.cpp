#include "apps/preview/shown.h"

#include <algorithm>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <unistd.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/frame_ranges.h"
#include "apps/one_line.h"
#include "apps/pipeline/stop.h"
#include "render/error.h"
#include "render/png.h"
#include "render/png_read.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr int most_shown = 240;   // more are thinned out
constexpr Size box = {640, 640};  // of a small picture
constexpr int compression = 1;    // they live for seconds
constexpr const char* prefix = ".work.";

/// What of another size lies in the middle, between dark borders.
render::Picture fitted(const render::Picture& picture, Size size) {
  const Size inner = size_within({picture.width, picture.height}, size);
  render::Picture small = resized(picture, inner);
  if (inner == size) return small;
  render::Picture canvas = filled(size, {24, 24, 26});
  put_picture(canvas, (size.width - inner.width) / 2, (size.height - inner.height) / 2, small);
  return canvas;
}

/// The picture, or nothing and the frame's problem.
std::optional<render::Picture> read_picture(const fs::path& file, ShownFrame& frame) {
  try {
    const render::Pixels pixels = render::read_png(read_file(file), file.string());
    frame.size = {pixels.width, pixels.height};
    return opaque_picture(pixels);
  } catch (const render::SettingsError& e) {
    frame.problem = one_line(e.what());
  } catch (const Error& e) {
    frame.problem = one_line(e.what());
  }
  return std::nullopt;
}

/// The first picture that can be read gives its size to all.
void choose_size(const PreviewMaterial& m, Shown& shown) {
  for (ShownFrame& frame : shown.frames) {
    if (!read_picture(m.pictures.at(frame.frame), frame)) continue;
    shown.picture = frame.size;
    shown.size = size_within(frame.size, box);
    return;
  }
  wrong_input(shown.frames.front().problem);
}

void tell_problems(const Shown& shown, PreviewMaterial& m) {
  std::vector<int> unreadable, others;
  std::string problem;
  for (const ShownFrame& frame : shown.frames) {
    if (frame.small.empty()) {
      if (unreadable.empty()) problem = frame.problem;
      unreadable.push_back(frame.frame);
    } else if (frame.size != shown.picture) {
      others.push_back(frame.frame);
    }
  }
  if (!unreadable.empty()) {
    m.remarks.push_back(fmt::format("{} cannot be read: {} ({})",
                                    unreadable.size() == 1 ? "a picture" : "pictures",
                                    ranges_text(unreadable), problem));
  }
  if (!others.empty()) {
    m.remarks.push_back(fmt::format("another size than {} x {}: {}", shown.picture.width,
                                    shown.picture.height, ranges_text(others)));
  }
}

}  // namespace

std::vector<const ShownFrame*> Shown::readable() const {
  std::vector<const ShownFrame*> all;
  for (const ShownFrame& frame : frames) {
    if (!frame.small.empty()) all.push_back(&frame);
  }
  return all;
}

WorkFolder::WorkFolder(const fs::path& out) : path_(out / fmt::format("{}{}.tmp", prefix, ::getpid())) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(out, error)) {  // of a killed process
    const std::string name = entry.path().filename().string();
    if (entry.is_directory(error) && name.starts_with(prefix) && name.ends_with(".tmp"))
      fs::remove_all(entry.path(), error);
  }
  make_folder(path_);
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::size_t> evenly(std::size_t n, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t count = std::min(n, most);
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(count == 1 ? 0 : (i * (n - 1) + (count - 1) / 2) / (count - 1));
  return chosen;
}

Shown choose_shown(const PreviewMaterial& m) {
  Shown shown;
  const int pictures = static_cast<int>(m.pictures.size());
  if (pictures == 0) return shown;
  shown.every = (pictures + most_shown - 1) / most_shown;
  int i = 0;
  for (const auto& [number, file] : m.pictures) {
    if (i++ % shown.every == 0)
      shown.frames.push_back({.frame = number, .small = {}, .size = {}, .problem = {}});
  }
  choose_size(m, shown);
  return shown;
}

void make_small(Shown& shown, PreviewMaterial& m, const fs::path& folder, Progress& progress) {
  progress.begin(static_cast<int>(shown.frames.size()));
  std::mutex mutex;
  std::optional<Error> failure;  // no exception may leave a task
  sim::parallel_for(static_cast<int>(shown.frames.size()), 1, [&](int begin, int end) {
    for (int k = begin; k < end && !stop_asked(); ++k) {
      ShownFrame& frame = shown.frames[static_cast<std::size_t>(k)];
      try {
        const std::optional<render::Picture> picture = read_picture(m.pictures.at(frame.frame), frame);
        if (picture) {
          frame.small = folder / fmt::format("{:06}.png", k);
          write_file(frame.small, render::encode_png(fitted(*picture, shown.size), compression));
        }
      } catch (const Error& e) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = e;
      }
      progress.frame_done();
    }
  });
  progress.end();
  if (failure) throw *failure;
  tell_problems(shown, m);
}

}  // namespace lagomorph::apps
