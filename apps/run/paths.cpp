#include "apps/run/paths.h"

#include "apps/run/channel_files.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

std::string frame_file(int frame, std::string_view extension) { return FrameNames().file(frame, extension); }

std::optional<int> frame_of(const fs::path& file, std::string_view extension) {
  return FrameNames().frame_of(file, extension);
}

fs::path RunPaths::state(int frame) const { return states() / frame_file(frame, ".npy"); }
fs::path RunPaths::picture(int frame) const { return pictures() / names_.file(frame, ".png"); }
fs::path RunPaths::record(int frame) const { return records() / frame_file(frame, ".json"); }
fs::path RunPaths::channel(std::string_view name) const { return channels() / channel_of(name); }
fs::path RunPaths::channel(std::string_view name, int frame) const {
  return channel(name) / names_.file(frame, channel_extension(name));
}

}  // namespace lagomorph::apps
