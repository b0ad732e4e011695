#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/file_io.h"
#include "apps/plot/run_figures.h"
#include "render/png.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr int compression = 9;

/// The drawing in the formats asked for; returns the names of the files.
std::vector<std::string> write_drawing(const Drawing& drawing, const fs::path& out, const std::string& name,
                                       const std::optional<std::string>& format) {
  std::vector<std::string> files;
  const auto write = [&](const char* extension, const std::string& bytes) {
    files.push_back(name + extension);
    write_file(out / files.back(), bytes);
  };
  if (format.value_or("svg") == "svg") write(".svg", svg_text(drawing));
  if (format.value_or("png") == "png") write(".png", render::encode_png(picture_of(drawing), compression));
  return files;
}

}  // namespace

ExitStatus plot_command(const Options& options) {
  const fs::path run = options.inputs.at(0);
  const std::vector<NamedFigure> figures = run_figures(read_run_table(run), options.columns);
  const fs::path out = options.out.value_or(run / "plot");
  make_folder(out);
  remove_leftovers(out);
  nlohmann::ordered_json json = {{"out", out.string()}, {"figures", nlohmann::ordered_json::array()}};
  const auto tell = [&](const std::string& name, const Drawing& drawing, const std::vector<Curve>& curves) {
    nlohmann::ordered_json entry = {{"name", name},
                                    {"files", write_drawing(drawing, out, name, options.format)},
                                    {"curves", curves.size()}};
    json["figures"].push_back(std::move(entry));
  };
  std::vector<Figure> all;
  for (const NamedFigure& f : figures) {
    tell(f.name, draw_figure(f.figure), f.figure.curves);
    all.push_back(f.figure);
  }
  if (all.size() > 1) tell("overview", draw_overview(all), {});
  if (options.json) {
    print(json.dump() + "\n");
  } else if (!options.quiet) {
    for (const auto& figure : json["figures"]) {
      for (const auto& file : figure["files"])
        print(fmt::format("{}\n", (out / file.get<std::string>()).string()));
    }
  }
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
