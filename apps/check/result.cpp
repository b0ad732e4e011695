#include "apps/check/result.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/shell.h"

namespace lagomorph::apps {

std::string CheckFailure::line() const {
  std::string text = rule + " " + found;
  if (!limit.empty()) text += ", limit " + limit;
  if (!from.empty()) text += " by " + from;
  return text;
}

std::string decided_by_name(DecidedBy by) {
  switch (by) {
    case DecidedBy::nothing:
      return "nothing";
    case DecidedBy::bytes:
      return "bytes";
    case DecidedBy::hash:
      return "hash";
    case DecidedBy::pixels:
      return "pixels";
    case DecidedBy::metrics:
      break;
  }
  return "metrics";
}

int CheckResult::failed() const {
  return static_cast<int>(
      std::count_if(frames.begin(), frames.end(), [](const FrameResult& f) { return !f.passed(); }));
}

std::vector<const FrameResult*> worst_first(const CheckResult& result) {
  std::vector<const FrameResult*> worst;
  for (const FrameResult& frame : result.frames) {
    if (!frame.passed()) worst.push_back(&frame);
  }
  const auto badness = [](const FrameResult& f) { return f.figures ? f.figures->flip_tile.mean : 2.0; };
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const FrameResult* a, const FrameResult* b) { return badness(*a) > badness(*b); });
  return worst;
}

FrameCommands frame_commands(const CheckResult& result, int frame) {
  const std::string run = shell_word(result.run.string()), golden = shell_word(result.golden.string());
  return {fmt::format("lagomorph check {} {} --frames {}", run, golden, frame),
          fmt::format("lagomorph render {} --frames {} --force", run, frame),
          fmt::format("lagomorph approve {} {} --frames {}", run, golden, frame)};
}

}  // namespace lagomorph::apps
