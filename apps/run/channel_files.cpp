#include "apps/run/channel_files.h"

#include "render/channels.h"

namespace lagomorph::apps {

std::vector<std::string> channel_formats() { return {"npy", "exr", "exr_multilayer", "png"}; }

std::vector<std::string> channel_files(const render::RenderSettings& render) {
  std::vector<std::string> files;
  if (render.channel_format == "exr_multilayer") files.emplace_back(multilayer_file);
  for (const std::string& name : render.channels) {
    if (render.channel_format == "npy" || name == render::statistics_channel) {
      files.push_back(name);
    } else if (render.channel_format == "exr") {
      files.push_back(name + exr_extension);
    } else if (render.channel_format == "png") {
      files.push_back(name + png_extension);
    }
  }
  return files;
}

std::string_view channel_extension(std::string_view file) {
  for (const std::string_view extension : {exr_extension, png_extension})
    if (file.ends_with(extension)) return extension;
  return ".npy";
}

std::string_view channel_of(std::string_view file) {
  if (file.ends_with(channel_extension(file))) file.remove_suffix(channel_extension(file).size());
  return file;
}

}  // namespace lagomorph::apps
