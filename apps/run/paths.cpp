#include "apps/run/paths.h"

#include <charconv>

#include <fmt/format.h>

#include "apps/run/channel_files.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

std::string frame_file(int frame, std::string_view extension) {
  return fmt::format("frame_{:04}{}", frame, extension);
}

std::optional<int> frame_of(const fs::path& file, std::string_view extension) {
  const std::string name = file.filename().string();
  constexpr std::string_view prefix = "frame_";
  if (!name.starts_with(prefix) || !name.ends_with(extension)) return std::nullopt;
  int frame = -1;
  std::from_chars(name.data() + prefix.size(), name.data() + name.size(), frame);
  if (frame < 0 || name != frame_file(frame, extension)) return std::nullopt;
  return frame;
}

fs::path RunPaths::state(int frame) const { return states() / frame_file(frame, ".npy"); }
fs::path RunPaths::picture(int frame) const { return pictures() / frame_file(frame, ".png"); }
fs::path RunPaths::record(int frame) const { return records() / frame_file(frame, ".json"); }
fs::path RunPaths::channel(std::string_view name) const { return channels() / channel_of(name); }
fs::path RunPaths::channel(std::string_view name, int frame) const {
  return channel(name) / frame_file(frame, channel_extension(name));
}

}  // namespace lagomorph::apps
