#include "apps/check/result_text.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "apps/frame_ranges.h"

namespace lagomorph::apps {
namespace {

constexpr std::size_t most_frames = 12;  // told one by one

std::string counted(std::size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string frame_text(const FrameResult& frame) {
  std::string text;
  const std::string label = fmt::format("  frame {}: ", frame.frame);
  for (const CheckFailure& failure : frame.failures)
    text += (text.empty() ? label : std::string(label.size(), ' ')) + failure.line() + "\n";
  for (const std::string& hint : frame.hints) text += std::string(label.size(), ' ') + hint + "\n";
  return text;
}

std::string bad_text(const SequenceResult& sequence) {
  std::vector<int> frames;
  for (const FrameRange& range : sequence.bad) {
    for (int frame = range.first; frame <= range.last; ++frame) frames.push_back(frame);
  }
  return ranges_text(frames);
}

std::string masked_text(const CheckResult& result) {
  double least = 1, most = 0;
  for (const FrameResult& frame : result.frames) {
    least = std::min(least, frame.masked);
    most = std::max(most, frame.masked);
  }
  if (most == 0) return "";
  if (least == most) return fmt::format("  masked: {:.2f} % of every picture\n", 100 * most);
  return fmt::format("  masked: {:.2f} to {:.2f} % of the pictures\n", 100 * least, 100 * most);
}

}  // namespace

std::string verdict_text(const CheckResult& result) {
  std::map<std::string, int> by;
  for (const FrameResult& frame : result.frames) {
    if (frame.passed()) ++by[decided_by_name(frame.decided_by)];
  }
  std::string how;
  for (const auto& [name, n] : by) how += (how.empty() ? "" : ", ") + fmt::format("{} by {}", n, name);
  const int failed = result.failed();
  const std::string all = counted(result.frames.size(), "frame");
  if (failed == 0) return fmt::format("{} the same ({})", all, how);
  return fmt::format("{} of {} {}{}", failed, all, failed == 1 ? "differs" : "differ",
                     how.empty() ? "" : fmt::format("; the same are {}", how));
}

std::string check_text(const CheckResult& result) {
  std::string text =
      fmt::format("{} against {}: {}\n", result.run.string(), result.golden.string(), verdict_text(result));
  for (const Cause& cause : result.causes) text += fmt::format("  {}: {}\n", cause.kind, cause.text);
  for (const SequenceFinding& finding : result.sequence.findings) text += fmt::format("  {}\n", finding.text);
  if (!result.passed()) text += fmt::format("  bad frames: {}\n", bad_text(result.sequence));
  const std::vector<const FrameResult*> worst = worst_first(result);
  for (std::size_t i = 0; i < std::min(worst.size(), most_frames); ++i) text += frame_text(*worst[i]);
  if (worst.size() > most_frames) text += fmt::format("  and {} more\n", worst.size() - most_frames);
  text += masked_text(result);
  for (const std::string& remark : result.remarks) text += fmt::format("  remark: {}\n", remark);
  return text + fmt::format("  report: {}\n", (result.out / "report.html").string());
}

}  // namespace lagomorph::apps
