#include "apps/run/channel_files.h"

#include "render/channels.h"

namespace lagomorph::apps {

std::vector<std::string> channel_formats() { return {"npy", "exr", "exr_multilayer"}; }

std::vector<std::string> channel_files(const render::RenderSettings& render) {
  std::vector<std::string> files;
  if (render.channel_format == "exr_multilayer") files.emplace_back(multilayer_file);
  for (const std::string& name : render.channels) {
    if (render.channel_format == "npy" || name == render::statistics_channel) {
      files.push_back(name);
    } else if (render.channel_format == "exr") {
      files.push_back(name + exr_extension);
    }
  }
  return files;
}

}  // namespace lagomorph::apps
