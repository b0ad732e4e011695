#include <fmt/format.h>

#include "apps/markdown.h"
#include "apps/preview/preview.h"
#include "apps/preview/story.h"

namespace lagomorph::apps {
namespace {

constexpr std::size_t longest_value = 2000;  // bytes; a list of frames may be long

std::string shortened(std::string text) {
  if (text.size() <= longest_value) return text;
  text.resize(longest_value);
  return text + "…";
}

}  // namespace

std::string summary_markdown(const Preview& preview) {
  const PreviewMaterial& m = preview.material;
  std::string text = fmt::format("## {}\n\n", markdown_text(shortened(headline(m))));
  if (!preview.contact_sheet.empty())
    text += fmt::format("![Contact sheet of {}]({})\n\n", markdown_text(m.name), preview.contact_sheet);
  for (const std::string& remark : m.remarks)
    text += fmt::format("- ⚠️ {}\n", markdown_text(shortened(remark)));
  if (!m.remarks.empty()) text += "\n";
  text += "| | |\n|---|---|\n";
  for (const auto& [label, value] : run_facts(m, preview.shown))
    text += fmt::format("| {} | {} |\n", label, markdown_text(shortened(value)));
  for (const Animation& animation : preview.animations) {
    text += fmt::format("| {} | {} x {} pixels, {} frames at {:.4g} fps, {:.1f} KiB |\n",
                        markdown_text(animation.file.string()), animation.size.width, animation.size.height,
                        animation.frames, animation.rate, static_cast<double>(animation.bytes) / 1024);
  }
  return text;
}

}  // namespace lagomorph::apps
