#include "apps/check/check.h"

#include <algorithm>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "apps/check/causes.h"
#include "apps/check/compare_frame.h"
#include "apps/check/golden_file.h"
#include "apps/check/golden_folder.h"
#include "apps/check/heat.h"
#include "apps/check/probe.h"
#include "apps/check/run_hashes.h"
#include "apps/check/sequence.h"
#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/frame_ranges.h"
#include "apps/hash.h"
#include "apps/pipeline/stop.h"
#include "apps/pipeline/stopwatch.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

/// The name that reports give to the golden.
std::string name_of(const fs::path& golden) {
  const fs::path whole = fs::absolute(golden).lexically_normal();
  const fs::path last = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
  return last.empty() ? "golden" : last.string();
}

class Check {
public:
  Check(const CheckRequest& request, Progress& progress)
      : request_(request),
        progress_(progress),
        file_(read_golden_file(request.golden, request.set, request.preset)),
        run_(list_pictures(request.run, "run")),
        golden_(read_golden_folder(request.golden)),
        masks_(file_.masks) {
    if (request.pixels_per_degree) file_.pixels_per_degree = *request.pixels_per_degree;
    if (request.variant && !golden_.variants.contains(*request.variant)) {
      wrong_input(
          fmt::format("--variant {}: {} has no such variant", *request.variant, request.golden.string()));
    }
    choose_frames();
  }

  CheckResult run() {
    const Stopwatch watch;
    if (request_.pictures) remove_heat(request_.out);
    CheckResult result;
    result.run = request_.run;
    result.golden = request_.golden;
    result.out = request_.out;
    result.name = name_of(request_.golden);
    result.preset = file_.preset();
    result.limits = file_.limits().told();
    result.pixels_per_degree = file_.pixels_per_degree;
    result.frames.resize(numbers_.size());
    progress_.begin(static_cast<int>(numbers_.size()));
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, numbers_.size(), 1),
        [&](const auto& range) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            if (stop_asked()) throw Error(stop_status(), "stopped: no report was written");
            result.frames[i] = judge(numbers_[i]);
            progress_.frame_done();
          }
        },
        tbb::simple_partitioner());
    progress_.end();
    judge_flicker(result.frames, biases_, file_);
    draw_flickering(result.frames);
    result.sequence = analyse_sequence(result.frames, probes_);
    result.remarks = remarks(result.frames);
    if (!result.passed()) tell_causes(result);
    result.seconds = watch.seconds();
    return result;
  }

private:
  /// The union of both sides' frames, within --frames. One pair at least, or all of it is a mistake.
  void choose_frames() {
    std::set<int> all = golden_.frames();
    const std::set<int> known = all;
    for (const auto& [frame, file] : run_.pictures) all.insert(frame);
    bool paired = false;
    for (const int frame : all) {
      if (request_.frames && (frame < request_.frames->first || frame > request_.frames->last)) continue;
      const bool in_run = run_.pictures.contains(frame), in_golden = known.contains(frame);
      paired |= in_run && in_golden;
      if (in_run && !in_golden && file_.ignore_extra) {
        ignored_.push_back(frame);
      } else {
        numbers_.push_back(frame);
      }
    }
    if (request_.frames && !all.empty() && request_.frames->last > *all.rbegin()) {
      wrong_input(fmt::format("--frames {}..{}: the last frame of {} and {} is {}", request_.frames->first,
                              request_.frames->last, request_.run.string(), request_.golden.string(),
                              *all.rbegin()));
    }
    if (paired || !request_.needs_pair) return;
    const auto frames_text = [](const auto& frames) {
      std::vector<int> list;
      for (const auto& entry : frames) {
        if constexpr (std::is_same_v<std::decay_t<decltype(entry)>, int>) {
          list.push_back(entry);
        } else {
          list.push_back(entry.first);
        }
      }
      return ranges_text(list);
    };
    wrong_input(fmt::format(
        "no frame can be checked: {} has pictures of frames {}, {} of {}{}", run_.folder.string(),
        frames_text(run_.pictures), golden_.own.folder.string(), frames_text(known),
        request_.frames
            ? fmt::format(", and only {}..{} are asked for", request_.frames->first, request_.frames->last)
            : ""));
  }

  FrameResult judge(int frame) {
    const Stopwatch watch;
    FrameResult result = judge_what_is_there(frame);
    result.seconds = watch.seconds();
    return result;
  }

  FrameResult judge_what_is_there(int frame) {
    FrameResult result;
    result.frame = frame;
    result.fresh = run_.of(frame);
    const std::vector<GoldenFolder::Candidate> candidates = golden_.candidates(frame, request_.variant);
    if (!candidates.empty()) result.golden = candidates.front().picture;
    const auto hash = golden_.hashes.find(frame);
    const bool has_golden = !candidates.empty() || hash != golden_.hashes.end();
    if (result.fresh.empty()) {
      result.failures.push_back(
          {"missing", fmt::format("in {}: it has no picture of frame {}", run_.folder.string(), frame), "",
           ""});
      return result;
    }
    if (!has_golden) {
      result.failures.push_back(
          {"extra", fmt::format("in {}: the golden has no frame {}", run_.folder.string(), frame), "", ""});
      return result;
    }
    if (candidates.empty()) return judge_hash(std::move(result), hash->second);
    return judge_pictures(frame, candidates);
  }

  /// The first candidate that passes; when none does, the first.
  FrameResult judge_pictures(int frame, const std::vector<GoldenFolder::Candidate>& candidates) {
    const Limits limits = file_.limits(frame);
    std::optional<ComparedFrame> first;
    for (const GoldenFolder::Candidate& candidate : candidates) {
      ComparedFrame compared = compare_frame({frame, candidate.picture, run_.of(frame), candidate.variant},
                                             limits, masks_, file_.pixels_per_degree);
      if (compared.result.passed()) {
        keep(compared);
        return std::move(compared.result);
      }
      if (!first) first = std::move(compared);
    }
    keep(*first);
    if (first->flip) {
      const Probe probe = probe_frame(golden_.own, frame, *first->golden, *first->fresh);
      first->result.hints = probe.hints();
      if (request_.pictures) write_heat(request_.out, *first);
      const std::lock_guard lock(mutex_);
      probes_[frame] = probe;
    }
    return std::move(first->result);
  }

  FrameResult judge_hash(FrameResult result, const PictureHash& golden) {
    try {
      const std::string bytes = read_file(result.fresh);
      result.decided_by = DecidedBy::hash;
      result.fresh_sha256 = sha256(bytes);
      if (result.fresh_sha256 == golden.file) return result;
      const std::string pixels = pixels_sha256(render::read_png(bytes, result.fresh.string()));
      if (pixels == golden.pixels) return result;
      result.failures.push_back(
          {"hash",
           fmt::format("of the pixels is {:.12}, the golden's {:.12}, and its picture is not kept", pixels,
                       golden.pixels),
           "", ""});
    } catch (const Error& error) {
      if (error.status != ExitStatus::wrong_input) throw;
      result.failures.push_back({"unreadable", error.what(), "", ""});
    } catch (const render::PictureError& error) {
      result.failures.push_back({"unreadable", error.what(), "", ""});
    }
    return result;
  }

  void keep(const ComparedFrame& compared) {
    if (!compared.result.figures) return;
    const std::lock_guard lock(mutex_);
    biases_[compared.result.frame] = compared.bias;
  }

  /// Heat of frames that fail only beside their neighbours.
  void draw_flickering(std::vector<FrameResult>& frames) {
    if (!request_.pictures) return;
    for (FrameResult& frame : frames) {
      if (frame.passed() || !frame.flicker || !frame.heat.empty() || frame.golden.empty()) continue;
      if (frame.decided_by != DecidedBy::metrics) continue;  // there is nothing to see in it alone
      Limits none;
      none[LimitName::max_abs] = {-1.0, ""};  // keeps the pictures
      ComparedFrame again = compare_frame({frame.frame, frame.golden, frame.fresh, frame.variant}, none,
                                          masks_, file_.pixels_per_degree);
      if (!again.flip) continue;
      write_heat(request_.out, again);
      frame.heat = again.result.heat;
      frame.panel = again.result.panel;
    }
  }

  /// A folder of pictures alone has no story, and nobody expects causes of it.
  void tell_causes(CheckResult& result) const {
    const std::optional<RunStory> run = read_run_story(request_.run);
    if (!run) return;
    std::optional<RunStory> golden;
    if (request_.variant) golden = read_run_story(request_.golden / "variants" / *request_.variant);
    if (!golden) golden = read_run_story(request_.golden);
    if (golden) {
      result.causes = find_causes(*run, *golden, result.frames);
    } else {
      result.remarks.push_back(
          fmt::format("{}: there is no run.json, so that causes cannot be told", request_.golden.string()));
    }
  }

  std::vector<std::string> remarks(const std::vector<FrameResult>& frames) const {
    std::vector<std::string> all;
    for (const PictureFolder* folder : {&run_, &golden_.own}) {
      if (folder->unnumbered.empty()) continue;
      all.push_back(fmt::format("{}: {} without a number left out, as {}", folder->folder.string(),
                                folder->unnumbered.size() == 1
                                    ? "1 picture"
                                    : fmt::format("{} pictures", folder->unnumbered.size()),
                                folder->unnumbered.front()));
    }
    if (!ignored_.empty()) {
      all.push_back(
          fmt::format("frames that only the run has are ignored by golden.toml: {}", ranges_text(ignored_)));
    }
    std::map<std::string, std::vector<int>> without;
    for (const FrameResult& frame : frames) {
      if (!frame.no_light.empty()) without[frame.no_light].push_back(frame.frame);
    }
    for (const auto& [why, numbers] : without) {
      all.push_back(fmt::format(
          "the light's noise was not tested in frames {}: of tile_statistics {}; the other limits "
          "decided (render.channels = [\"tile_statistics\"] leaves them)",
          ranges_text(numbers), why));
    }
    const std::vector<int> others = pictures_unlike_run_json(request_.run, frames);
    if (!others.empty()) {
      all.push_back(
          fmt::format("{}: tells other hashes than the pictures have, of frames {}; the pictures were judged",
                      (request_.run / "run.json").string(), ranges_text(others)));
    }
    return all;
  }

  const CheckRequest& request_;
  Progress& progress_;
  GoldenFile file_;
  PictureFolder run_;
  GoldenFolder golden_;
  Masks masks_;
  std::vector<int> numbers_;  // of the frames that are judged, ascending
  std::vector<int> ignored_;
  std::mutex mutex_;  // of what follows
  std::map<int, render::TileBias> biases_;
  std::map<int, Probe> probes_;
};

}  // namespace

CheckResult check_run(const CheckRequest& request, Progress& progress) {
  return Check(request, progress).run();
}

}  // namespace lagomorph::apps
