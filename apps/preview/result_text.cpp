#include <fmt/format.h>

#include "apps/preview/preview.h"
#include "apps/preview/story.h"
#include "apps/utf8.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string size_text(std::uintmax_t bytes) {
  const double kib = static_cast<double>(bytes) / 1024;
  return kib < 1000 ? fmt::format("{:.0f} KiB", kib) : fmt::format("{:.1f} MiB", kib / 1024);
}

std::vector<std::string> files_of(const Preview& preview) {
  std::vector<std::string> files = {"summary.md"};
  if (!preview.page.empty()) files.insert(files.begin(), preview.page);
  if (!preview.contact_sheet.empty()) files.push_back(preview.contact_sheet);
  for (const Animation& animation : preview.animations) files.push_back(animation.file.string());
  return files;
}

}  // namespace

std::string preview_json(const Preview& preview) {
  const PreviewMaterial& m = preview.material;
  Json json = {{"run", valid_utf8(m.run.string())},
               {"name", valid_utf8(m.name)},
               {"headline", valid_utf8(headline(m))},
               {"out", valid_utf8(preview.out.string())},
               {"by_lagomorph", m.info.has_value()},
               {"pictures", frame_numbers(m.pictures)},
               {"states", frame_numbers(m.records)},
               {"unreadable", Json::array()},
               {"files", Json::array()},
               {"remarks", Json::array()}};
  for (const ShownFrame& frame : preview.shown.frames) {
    if (frame.small.empty()) json["unreadable"].push_back(frame.frame);
  }
  for (const std::string& file : files_of(preview)) {
    Json entry = {{"name", file}, {"bytes", std::filesystem::file_size(preview.out / file)}};
    for (const Animation& a : preview.animations) {
      if (a.file != file) continue;
      entry.update(
          {{"width", a.size.width}, {"height", a.size.height}, {"frames", a.frames}, {"fps", a.rate}});
    }
    json["files"].push_back(std::move(entry));
  }
  for (const std::string& remark : m.remarks) json["remarks"].push_back(valid_utf8(remark));
  return json.dump() + "\n";
}

std::string preview_text(const Preview& preview) {
  std::string text = headline(preview.material) + "\n";
  for (const std::string& file : files_of(preview)) {
    std::string about = size_text(std::filesystem::file_size(preview.out / file));
    for (const Animation& a : preview.animations) {
      if (a.file == file)
        about +=
            fmt::format(", {} x {}, {} frames at {:.4g} fps", a.size.width, a.size.height, a.frames, a.rate);
    }
    text += fmt::format("  {}: {}\n", (preview.out / file).string(), about);
  }
  for (const std::string& remark : preview.material.remarks) text += "  remark: " + remark + "\n";
  return text;
}

}  // namespace lagomorph::apps
