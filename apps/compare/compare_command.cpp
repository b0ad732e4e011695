#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/compare/compare_floats.h"
#include "apps/compare/heat_file.h"
#include "apps/compare/verdict.h"
#include "apps/file_io.h"
#include "apps/pipeline/production.h"
#include "render/image_compare/flip_filters.h"
#include "render/png_read.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

render::Pixels read_picture(const std::string& file) {
  if (std::error_code none; fs::is_directory(file, none)) {
    wrong_input(fmt::format("{}: is a folder; compare takes two pictures, and check two folders", file));
  }
  return render::read_png(read_file(file), file);
}

/// The map of FLIP's errors as a picture; black where pictures are equal.
void write_heat(const fs::path& file, render::ErrorMap map, const render::Pixels& of) {
  if (map.values.empty()) map = {of.width, of.height, std::vector<float>(of.pixel_count())};
  write_heat_map(file, map);
}

}  // namespace

ExitStatus compare_command(const Options& options) {
  const sim::ThreadLimit limit(thread_count(options));
  const std::string &a = options.inputs.at(0), &b = options.inputs.at(1);
  if (is_float_channel(a) && is_float_channel(b)) return compare_floats(options);
  const double pixels_per_degree = options.pixels_per_degree.value_or(render::default_pixels_per_degree);
  const render::Pixels first = read_picture(a), second = read_picture(b);
  PairVerdict verdict = judge_pair(first, second, pixels_per_degree);
  if (verdict.comparison) {
    if (options.heat) write_heat(*options.heat, verdict.comparison->flip, first);
    if (options.out) write_heat(*options.out / "heat.png", verdict.comparison->flip, first);
  }
  if (options.json) {
    print(verdict_json(verdict));
  } else if (!options.quiet) {
    print(verdict_text(verdict, a, b, pixels_per_degree));
  }
  return verdict.same() ? ExitStatus::done : ExitStatus::different;
}

}  // namespace lagomorph::apps
