#include "render/renderer.h"

#include "render/backends.h"
#include "render/error.h"
#include "render/raster/optics_stand_in.h"
#include "render/raster/stand_ins.h"

namespace lagomorph::render {
namespace {

struct BackEnd {
  const char* name;
  std::unique_ptr<Renderer> (*make)(const RenderSettings&, int threads);
};
constexpr BackEnd backends[] = {
    {"raster", make_raster_renderer},
    {"path", make_path_renderer},
    {"null", make_null_renderer},
};

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& n : names) text += (text.empty() ? "" : ", ") + n;
  return text;
}

void check_range(const char* key, long value, long low, long high) {
  if (value >= low && value <= high) return;
  throw SettingsError(std::string(key) + " = " + std::to_string(value) + " must be in " +
                      std::to_string(low) + ".." + std::to_string(high));
}

}  // namespace

std::vector<std::string> renderer_names() {
  std::vector<std::string> names;
  for (const BackEnd& row : backends) names.emplace_back(row.name);
  return names;
}

std::unique_ptr<Renderer> make_renderer(const RenderSettings& settings, int threads) {
  check_range("render.width", settings.width, 1, 16384);
  check_range("render.height", settings.height, 1, 16384);
  for (const std::string& channel : settings.channels) {
    if (channel_kind(channel).path_only && settings.backend == "raster") {
      throw SettingsError("render.channels: '" + channel + "' is drawn by render.backend = \"path\" only");
    }
  }
  for (const BackEnd& row : backends) {
    if (settings.backend == row.name) return row.make(settings, threads);
  }
  throw SettingsError("render.backend: unknown back end '" + settings.backend + "'; known are " +
                      joined(renderer_names()));
}

std::vector<std::string> renderer_remarks(const RenderSettings& settings, const CameraSettings& camera,
                                          const RenderScene& scene) {
  std::vector<std::string> remarks;
  if (settings.backend == "raster") {
    remarks = raster::stand_in_remarks(camera, scene);
    for (std::string& remark : raster::optics_remarks(scene, settings.raster))
      remarks.push_back(std::move(remark));
  }
  if (settings.backend == "path" && settings.path.clamp > 0.0F) {
    std::string value = std::to_string(settings.path.clamp);
    value.erase(value.find_last_not_of('0') + 1);
    if (value.back() == '.') value.pop_back();
    remarks.push_back("render.path.clamp = " + value +
                      ": indirect light above it is cut, so that pictures are somewhat too dark");
  }
  if ((settings.channel_format == "exr" || settings.channel_format == "png") && settings.channels.empty())
    remarks.push_back("render.channel_format = " + settings.channel_format +
                      " has no effect without render.channels");
  for (std::string& remark : remarks) remark.insert(0, settings.backend + ": ");
  return remarks;
}

}  // namespace lagomorph::render
