#include <unistd.h>

#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/file_io.h"
#include "apps/pipeline/production.h"
#include "apps/pipeline/stop.h"
#include "apps/preview/contact_sheet.h"
#include "apps/preview/page.h"
#include "apps/preview/preview.h"
#include "render/png.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr int sheet_compression = 9;  // of the contact sheet

/// What shows pictures; without one, what an earlier preview left goes.
void make_pictures(Preview& preview, const WorkFolder& work, Progress& progress) {
  const fs::path sheet = preview.out / "contact_sheet.png";
  if (preview.material.pictures.empty()) {
    remove_file(sheet);
  } else {
    make_small(preview.shown, preview.material, work.path(), progress);
    if (stop_asked()) return;
    write_file(sheet, render::encode_png(contact_sheet(preview.material, preview.shown), sheet_compression));
    preview.contact_sheet = "contact_sheet.png";
  }
  preview.animations =
      make_animations(preview.material, preview.shown, preview.out, work.path(), [] { return stop_asked(); });
}

}  // namespace

ExitStatus preview_command(const Options& options) {
  const StopSignals signals;
  const sim::ThreadLimit limit(thread_count(options));
  Progress progress(options.quiet || options.json || ::isatty(STDERR_FILENO) == 0);
  const fs::path run = options.inputs.at(0);
  Preview preview;
  preview.material = read_material(run, options.frames);
  preview.shown = choose_shown(preview.material);
  preview.out = options.out.value_or(run / "preview");
  make_folder(preview.out);
  remove_leftovers(preview.out);
  const WorkFolder work(preview.out);
  make_pictures(preview, work, progress);
  const std::vector<PageFrame> frames = page_frames(preview.shown, work.path(), [] { return stop_asked(); });
  if (stop_asked()) return stop_status();
  write_file(preview.out / "index.html", preview_page(preview.material, preview.shown, frames));
  preview.page = "index.html";
  write_file(preview.out / "summary.md", summary_markdown(preview));
  if (options.json) {
    print(preview_json(preview));
  } else if (!options.quiet) {
    print(preview_text(preview));
  }
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
