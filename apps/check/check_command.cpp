#include <cstdio>
#include <string>

#include <unistd.h>

#include "apps/check/check.h"
#include "apps/check/ci_output.h"
#include "apps/check/junit.h"
#include "apps/check/report_html.h"
#include "apps/check/report_json.h"
#include "apps/check/result_text.h"
#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/file_io.h"
#include "apps/pipeline/production.h"
#include "apps/pipeline/stop.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

void write_reports(const CheckResult& result, const std::string& json, bool assets) {
  make_folder(result.out);
  remove_leftovers(result.out);
  write_file(result.out / "report.json", json);
  write_file(result.out / "junit.xml", junit_xml(result, fs::current_path()));
  write_report_html(result, assets);
}

}  // namespace

ExitStatus check_command(const Options& options) {
  if (options.calibrate) return calibrate_command(options);
  if (options.yes) wrong_input("--yes is for --calibrate");
  const StopSignals signals;
  const sim::ThreadLimit limit(thread_count(options));
  if (options.github) require_github_summary();
  // A check takes seconds: only who watches a terminal is told of each frame.
  Progress progress(options.quiet || options.json || ::isatty(STDERR_FILENO) == 0);
  const fs::path run = options.inputs.at(0);
  const CheckResult result = check_run({.run = run,
                                        .golden = options.inputs.at(1),
                                        .out = options.out.value_or(run / "check"),
                                        .frames = options.frames,
                                        .set = options.set,
                                        .preset = options.preset,
                                        .variant = options.variant,
                                        .pixels_per_degree = options.pixels_per_degree},
                                       progress);
  const std::string json = report_json(result);
  write_reports(result, json, options.assets);
  if (options.json) {
    print(json);
  } else if (!options.quiet) {
    print(check_text(result));
  }
  if (options.ctest && !options.json) print(ctest_measurements(result));
  if (options.github) {
    append_github_summary(result);
    // GitHub reads both; with --json only stderr is left for words.
    const std::string annotations = github_annotations(result);
    if (options.json) {
      std::fputs(annotations.c_str(), stderr);
    } else {
      print(annotations);
    }
  }
  return result.passed() ? ExitStatus::done : ExitStatus::different;
}

}  // namespace lagomorph::apps
