#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/approve/approve.h"
#include "apps/check/check.h"
#include "apps/check/golden_file.h"
#include "apps/check/golden_folder.h"
#include "apps/check/report_json.h"
#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/hash.h"
#include "apps/run/paths.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The frames that failed in a report, with the sha-256 of the picture that was judged; empty where none was.
std::map<int, std::string> failed_in(const fs::path& report) {
  std::map<int, std::string> failed;
  try {
    const Json json = Json::parse(read_file(report));
    if (json.at("format") != "lagomorph-check-report" || json.at("version") != report_version) {
      wrong_input(fmt::format("{}: is a report of another version than {}", report.string(), report_version));
    }
    for (const Json& frame : json.at("frames")) {
      if (frame.at("passed").get<bool>()) continue;
      const Json& sha256 = frame.at("new_sha256");
      failed[frame.at("frame").get<int>()] = sha256.is_null() ? "" : sha256.get<std::string>();
    }
  } catch (const Json::exception& e) {
    wrong_input(fmt::format("{}: is no report of lagomorph check ({})", report.string(), e.what()));
  }
  return failed;
}

/// Where the golden's picture of a frame is, or goes: beside the others of its kind.
fs::path place_of(const ApproveRequest& request, const std::optional<GoldenFolder>& golden, int frame,
                  const fs::path& from) {
  const PictureFolder* folder = golden && !request.variant ? &golden->own : nullptr;
  if (golden && request.variant && golden->variants.contains(*request.variant))
    folder = &golden->variants.at(*request.variant);
  if (folder != nullptr) {
    if (const fs::path there = folder->of(frame); !there.empty()) return there;
    const bool plain = !request.variant && !folder->pictures.empty() && folder->folder == request.golden;
    if (plain) return folder->folder / from.filename();
  }
  const fs::path root =
      request.variant ? variant_pictures(request.golden, *request.variant) : request.golden / "frames";
  return root / frame_file(frame, ".png");
}

void refuse_unreadable(const FrameResult& frame) {
  for (const CheckFailure& failure : frame.failures) {
    // The golden's own may be unreadable: it is to be replaced.
    if (failure.rule == "unreadable" && failure.found.starts_with(frame.fresh.string() + ":"))
      wrong_input(failure.found);
  }
  if (frame.failures.size() == 1 && frame.failures.front().rule == "extra") {
    render::read_png(read_file(frame.fresh), frame.fresh.string());
  }
}

class Planner {
public:
  Planner(const ApproveRequest& request, Progress& progress) : request_(request), progress_(progress) {}

  Approval plan() {
    const PictureFolder run = list_pictures(request_.run, "run");
    if (request_.report) judged_ = failed_in(*request_.report);
    if (is_there(request_.golden)) {
      golden_ = read_golden_folder(request_.golden);
    }
    file_ = read_golden_file(request_.golden, {}, std::nullopt);
    choose_states();
    bool any = false;
    for (const auto& [frame, picture] : run.pictures) any |= is_wanted(frame);
    if (request_.report) {
      for (const auto& [frame, sha256] : *judged_) {
        if (is_wanted(frame) && run.of(frame).empty()) approval_.missing.push_back(frame);
      }
    }
    if (!any && !(judged_ && judged_->empty())) {
      wrong_input(
          fmt::format("{}: has no picture of the frames that are to be approved", run.folder.string()));
    }
    for (const FrameResult& frame : judged_frames(run)) take(frame);
    return std::move(approval_);
  }

private:
  bool is_wanted(int frame) const {
    if (request_.frames && (frame < request_.frames->first || frame > request_.frames->last)) return false;
    return !judged_ || judged_->contains(frame);
  }

  /// Every wanted frame of the run, held against the golden as it is.
  std::vector<FrameResult> judged_frames(const PictureFolder& run) {
    std::vector<FrameResult> frames;
    if (golden_) {
      CheckRequest check;
      check.run = request_.run;
      check.golden = request_.golden;
      check.frames = request_.frames;
      if (request_.frames) check.set = {"extra=fail"};  // those asked for are meant
      check.needs_pair = false;
      check.pictures = false;
      frames = check_run(check, progress_).frames;
    } else {
      for (const auto& [number, picture] : run.pictures) {
        FrameResult& frame = frames.emplace_back();
        frame.frame = number;
        frame.fresh = picture;
        frame.failures.push_back({"extra", "there is no golden yet", "", ""});
      }
    }
    std::erase_if(frames, [&](const FrameResult& f) { return f.fresh.empty() || !is_wanted(f.frame); });
    return frames;
  }

  void take(const FrameResult& frame) {
    refuse_unreadable(frame);
    if (judged_) refuse_another(frame);
    if (frame.passed() && !request_.passing_too) {
      approval_.untouched.push_back(frame.frame);
      return;
    }
    AcceptedFrame accepted{.frame = frame.frame,
                           .from = frame.fresh,
                           .to = place_of(request_, golden_, frame.frame, frame.fresh),
                           .state = state_of(frame.frame),
                           .only_hash = !request_.variant && frame.frame % file_.keep_every != 0,
                           .is_new = !frame.failures.empty() && frame.failures.front().rule == "extra",
                           .changes = {}};
    if (!accepted.is_new) {
      for (const CheckFailure& failure : frame.failures) accepted.changes.push_back(failure.line());
      accepted.changes.insert(accepted.changes.end(), frame.hints.begin(), frame.hints.end());
    }
    approval_.accepted.push_back(std::move(accepted));
  }

  /// golden.toml is what later approvals go by, so that none may say otherwise.
  void choose_states() {
    if (!request_.states_every || *request_.states_every == file_.states_every) return;
    const fs::path toml = request_.golden / "golden.toml";
    if (is_there(toml)) {
      wrong_input(fmt::format("--states {}: {} says states_every = {}; change it there",
                              *request_.states_every, toml.string(), file_.states_every));
    }
    file_.states_every = *request_.states_every;
  }

  /// The state that is to be kept of a frame, where RUN has it.
  fs::path state_of(int frame) const {
    if (file_.states_every == 0 || frame % file_.states_every != 0) return {};
    const fs::path file = RunPaths(request_.run).state(frame);
    return is_there(file) ? file : fs::path();
  }

  /// Who approves a report has seen these pictures and no others.
  void refuse_another(const FrameResult& frame) const {
    const std::string& seen = judged_->at(frame.frame);
    if (seen.empty() || sha256_file(frame.fresh) == seen) return;
    wrong_input(fmt::format("{}: is another picture than {} judged; check again", frame.fresh.string(),
                            request_.report->string()));
  }

  const ApproveRequest& request_;
  Progress& progress_;
  std::optional<std::map<int, std::string>> judged_;
  std::optional<GoldenFolder> golden_;
  GoldenFile file_;
  Approval approval_;
};

}  // namespace

Approval plan_approval(const ApproveRequest& request, Progress& progress) {
  return Planner(request, progress).plan();
}

}  // namespace lagomorph::apps
