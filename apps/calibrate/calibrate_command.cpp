#include <cstdio>
#include <set>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/calibrate/calibration.h"
#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/compare/figures_json.h"
#include "apps/file_io.h"
#include "apps/pipeline/production.h"
#include "apps/pipeline/stop.h"
#include "apps/run/lock.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Every case with its figures, over the frames the largest of what is harmless and the least of faults.
std::string table(const std::vector<CalibrationCase>& cases) {
  const auto& figures = calibrated_figures();
  std::string text = fmt::format("{:<19}", "");
  for (const CalibratedFigure& figure : figures) text += fmt::format("{:>15}", limit_row(figure.name).name);
  text += "\n";
  for (const bool harmless : {true, false}) {
    text += harmless ? "harmless, at most\n" : "faults, at least\n";
    std::set<std::string> told;
    for (const CalibrationCase& c : cases) {
      if (c.harmless != harmless || !told.insert(c.name).second) continue;
      text += fmt::format("  {:<17}", c.name);
      for (const CalibratedFigure& figure : figures) {
        double worst = figure.value(c.result);
        for (const CalibrationCase& other : cases) {
          if (other.name != c.name) continue;
          const double value = figure.value(other.result);
          worst = harmless ? std::max(worst, value) : std::min(worst, value);
        }
        text += fmt::format("{:>15.3g}", worst);
      }
      text += "\n";
    }
  }
  return text;
}

std::string limits_text(const Proposal& proposal) {
  std::string text;
  for (const ProposedLimit& limit : proposal.limits) {
    text += fmt::format("{} = {}: {}\n", limit_row(limit.name).name,
                        limit.value ? fmt::format("{}", *limit.value) : "off", limit.why);
  }
  return text;
}

std::string calibration_json(const std::vector<CalibrationCase>& cases, const Proposal& proposal,
                             const fs::path& file) {
  Json all = Json::array(), limits = Json::object();
  for (const CalibrationCase& c : cases) {
    Json figures = figures_json(*c.result.figures);
    figures["mean_abs"] = c.result.figures->differences.mean_absolute();
    figures["bias_tile_max"] = c.result.bias->tile.mean;
    figures["bias_mean"] = c.result.bias->mean;
    all.push_back(
        {{"name", c.name}, {"harmless", c.harmless}, {"frame", c.result.frame}, {"figures", figures}});
  }
  for (const ProposedLimit& limit : proposal.limits)
    limits[limit_row(limit.name).name] = limit.value ? Json(*limit.value) : Json("off");
  const Json json = {{"room", proposal.no_room.empty()},
                     {"no_room", proposal.no_room},
                     {"limits", limits},
                     {"written", file.empty() ? Json(nullptr) : Json(file.string())},
                     {"cases", all}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Where the limits are written: beside the reports, or as the golden's own on --yes.
fs::path write_limits(const Options& options, const Proposal& proposal,
                      const std::vector<CalibrationCase>& cases) {
  if (!options.yes) {
    const fs::path out = options.out.value_or(fs::path(options.inputs[0]) / "check");
    make_folder(out);
    write_file(out / "calibration.toml", proposal_toml(proposal, cases, ""));
    return out / "calibration.toml";
  }
  const fs::path golden = options.inputs[1], file = golden / "golden.toml";
  make_folder(golden);
  RunLock lock(golden);
  lock.take(RunLock::Kind::exclusive);
  std::error_code none;
  const std::string before = fs::exists(file, none) ? read_file(file) : "";
  write_file(file, proposal_toml(proposal, cases, before), Durable::yes);
  return file;
}

}  // namespace

ExitStatus calibrate_command(const Options& options) {
  const StopSignals signals;
  const int threads = thread_count(options);
  const sim::ThreadLimit limit(threads);
  Progress progress(options.quiet);
  GoldenFile golden = read_golden_file(options.inputs.at(1), options.set, options.preset);
  if (options.pixels_per_degree) golden.pixels_per_degree = *options.pixels_per_degree;
  const std::vector<CalibrationCase> cases = calibration_cases({.run = options.inputs.at(0),
                                                                .golden = options.inputs.at(1),
                                                                .frames = options.frames,
                                                                .threads = threads},
                                                               golden, progress);
  const Proposal proposal = propose_limits(cases);
  const bool has_room = proposal.no_room.empty();
  const fs::path file = has_room ? write_limits(options, proposal, cases) : fs::path();
  if (options.json) {
    print(calibration_json(cases, proposal, file));
  } else if (!options.quiet) {
    print(table(cases));
    if (has_room) print(limits_text(proposal) + fmt::format("written: {}\n", file.string()));
  }
  for (const std::string& fault : proposal.no_room)
    std::fprintf(stderr, "lagomorph: no room for limits: %s\n", fault.c_str());
  return has_room ? ExitStatus::done : ExitStatus::different;
}

}  // namespace lagomorph::apps
