#include "apps/check/sequence.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace lagomorph::apps {
namespace {

/// The frames of the range, in words.
std::string span_text(const FrameRange& frames) {
  return frames.first == frames.last ? fmt::format("in frame {}", frames.first)
                                     : fmt::format("from frame {} to {}", frames.first, frames.last);
}

/// What is the same of failing frames that follow each other: a run a value.
template <class Value, class Text>
void add_findings(const std::vector<FrameResult>& frames, const char* kind, const Value& value,
                  const Text& text, std::vector<SequenceFinding>& findings) {
  for (std::size_t i = 0; i < frames.size();) {
    const auto first = value(frames[i]);
    std::size_t end = i + 1;
    if (first) {
      while (end < frames.size() && value(frames[end]) == first) ++end;
      const FrameRange range{frames[i].frame, frames[end - 1].frame};
      findings.push_back({kind, range, text(*first) + " " + span_text(range)});
    }
    i = end;
  }
}

}  // namespace

void judge_flicker(std::vector<FrameResult>& frames, const std::map<int, render::TileBias>& biases,
                   const GoldenFile& golden) {
  std::vector<std::pair<std::size_t, std::vector<CheckFailure>>> flickering;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    FrameResult& frame = frames[i];
    const auto now = biases.find(frame.frame), before = biases.find(frame.frame - 1);
    if (now == biases.end() || before == biases.end() || now->second.width != before->second.width ||
        now->second.height != before->second.height) {
      continue;
    }
    const render::BiasFigures change =
        render::bias_figures(render::change_of_bias(before->second, now->second));
    frame.flicker = change.tile;
    frame.flicker_mean = change.mean;
    // A frame that fails is told; what comes back after it is no news.
    if (!frame.passed() || !frames[i - 1].passed()) continue;
    flickering.emplace_back(i, broken_flicker_limits(frame, golden.limits(frame.frame)));
  }
  for (auto& [i, failures] : flickering) frames[i].failures = std::move(failures);
}

SequenceResult analyse_sequence(const std::vector<FrameResult>& frames, const std::map<int, Probe>& probes) {
  SequenceResult result;
  const FrameResult* before = nullptr;
  for (const FrameResult& frame : frames) {
    if (!frame.passed()) {
      if (before != nullptr && !before->passed()) {
        result.bad.back().last = frame.frame;
      } else {
        result.bad.push_back({frame.frame, frame.frame});
      }
    }
    before = &frame;
  }
  const auto probe = [&](const FrameResult& frame) -> const Probe* {
    const auto found = probes.find(frame.frame);
    return found == probes.end() ? nullptr : &found->second;
  };
  add_findings(
      frames, "time_shift",
      [&](const FrameResult& f) -> std::optional<int> {
        const Probe* p = probe(f);
        if (p == nullptr || !p->matches) return std::nullopt;
        return *p->matches - f.frame;
      },
      [](int offset) {
        return fmt::format("matches the golden's frame {} {}", offset > 0 ? "+" : "-", std::abs(offset));
      },
      result.findings);
  add_findings(
      frames, "pixel_shift",
      [&](const FrameResult& f) -> std::optional<PixelShift> {
        return probe(f) == nullptr ? std::nullopt : probe(f)->shift;
      },
      [](const PixelShift& shift) { return "shifted by " + shift_text(shift); }, result.findings);
  add_findings(
      frames, "tone",
      [&](const FrameResult& f) -> std::optional<std::string> {
        const Probe* p = probe(f);
        if (p == nullptr || p->tone.empty()) return std::nullopt;
        return p->tone;
      },
      [](const std::string& tone) { return "only the tones differ: " + tone; }, result.findings);
  std::stable_sort(result.findings.begin(), result.findings.end(),
                   [](const auto& a, const auto& b) { return a.frames.first < b.frames.first; });
  return result;
}

}  // namespace lagomorph::apps
