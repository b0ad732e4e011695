#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "apps/approve/approve.h"
#include "apps/approve/prune.h"
#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/error.h"
#include "apps/frame_ranges.h"
#include "apps/pipeline/production.h"
#include "apps/pipeline/stop.h"
#include "sim/parallel.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string approval_text(const ApproveRequest& request, const Approval& approval) {
  std::string text;
  for (const AcceptedFrame& frame : approval.accepted) {
    std::string label = fmt::format("frame {}: ", frame.frame);
    if (frame.is_new) text += label + "new\n";
    if (!frame.is_new && frame.changes.empty()) text += label + "passes, and is renewed\n";
    for (const std::string& change : frame.changes) {
      text += label + change + "\n";
      label.assign(label.size(), ' ');
    }
  }
  if (!approval.missing.empty())
    text += fmt::format("missing in the run, so not approved: {}\n", ranges_text(approval.missing));
  const auto counted = [](std::size_t n) { return fmt::format("{} frame{}", n, n == 1 ? "" : "s"); };
  return text + fmt::format("{}{}: {} accepted, {} left as they are\n", request.golden.string(),
                            request.variant ? " (" + *request.variant + ")" : "",
                            counted(approval.accepted.size()), approval.untouched.size());
}

std::string approval_json(const ApproveRequest& request, const Approval& approval) {
  Json accepted = Json::array();
  for (const AcceptedFrame& frame : approval.accepted) {
    accepted.push_back({{"frame", frame.frame},
                        {"new", frame.is_new},
                        {"changes", frame.changes},
                        {"picture", frame.only_hash ? Json(nullptr) : Json(frame.to.string())}});
  }
  const Json json = {{"golden", request.golden.string()},
                     {"variant", request.variant ? Json(*request.variant) : Json(nullptr)},
                     {"accepted", accepted},
                     {"untouched", approval.untouched},
                     {"missing", approval.missing}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

ExitStatus prune_command(const Options& options, const fs::path& run, const fs::path& golden) {
  const std::vector<StaleGolden> stale = stale_goldens(run, golden);
  if (options.yes) prune(golden, stale);
  Json list = Json::array();
  std::string text;
  for (const StaleGolden& s : stale) {
    const std::string what = s.file.empty() ? "hash" : s.file.string();
    list.push_back({{"frame", s.frame}, {"what", what}});
    text += fmt::format("frame {}: {}\n", s.frame, what);
  }
  text += fmt::format("{}: {} stale{}\n", golden.string(), stale.size(),
                      stale.empty() ? ""
                      : options.yes ? ", deleted"
                                    : "; --prune --yes deletes them");
  const Json json = {{"golden", golden.string()}, {"stale", list}, {"deleted", options.yes}};
  if (options.json) {
    print(json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  } else if (!options.quiet) {
    print(text);
  }
  return ExitStatus::done;
}

}  // namespace

ExitStatus approve_command(const Options& options) {
  const StopSignals signals;
  const sim::ThreadLimit limit(thread_count(options));
  const fs::path run = options.inputs.at(0), golden = options.inputs.at(1);
  if (options.yes && !options.prune) wrong_input("--yes is for --prune");
  if (options.prune) return prune_command(options, run, golden);
  // A check takes seconds: only who watches a terminal is told of each frame.
  Progress progress(options.quiet || options.json || ::isatty(STDERR_FILENO) == 0);
  const ApproveRequest request{.run = run,
                               .golden = golden,
                               .frames = options.frames,
                               .report = options.report,
                               .variant = options.variant,
                               .passing_too = options.force,
                               .states_every = options.states_every};
  const Approval approval = plan_approval(request, progress);
  carry_out(request, approval);
  if (options.json) {
    print(approval_json(request, approval));
  } else if (!options.quiet) {
    print(approval_text(request, approval));
  }
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
