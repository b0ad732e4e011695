#include "apps/check/ci_output.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "apps/check/junit.h"
#include "apps/error.h"
#include "apps/markdown.h"
#include "apps/one_line.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_annotations = 10;

std::string measurement(const char* name, double value) {
  return fmt::format("<CTestMeasurement type=\"numeric/double\" name=\"{}\">{:.6g}</CTestMeasurement>\n",
                     name, value);
}

/// The largest of a figure over the frames that have it.
template <class Figure>
double largest(const CheckResult& result, const Figure& figure) {
  double most = 0;
  for (const FrameResult& frame : result.frames) {
    if (frame.figures) most = std::max(most, figure(*frame.figures));
  }
  return most;
}

std::string verdict(const CheckResult& result) {
  const std::size_t all = result.frames.size();
  if (result.passed()) return fmt::format("{} frame{} the same", all, all == 1 ? "" : "s");
  return fmt::format("{} of {} frame{} differ{}", result.failed(), all, all == 1 ? "" : "s",
                     result.failed() == 1 ? "s" : "");
}

std::string summary_row(const CheckResult& result, const FrameResult& frame) {
  std::string why;
  for (const CheckFailure& failure : frame.failures)
    why += (why.empty() ? "" : "<br>") + markdown_text(failure.line());
  for (const std::string& hint : frame.hints) why += "<br>" + markdown_text(hint);
  const auto figure = [&](const auto& of) {
    return frame.figures ? fmt::format("{:.4f}", of(*frame.figures)) : "–";
  };
  return fmt::format("| {} | {} | {} | {} | <code>{}</code> |\n", frame.frame, why,
                     figure([](const render::Figures& f) { return f.flip_tile.mean; }),
                     figure([](const render::Figures& f) { return f.flip_mean; }),
                     markdown_text(frame_commands(result, frame.frame).approve));
}

std::string summary_head(const CheckResult& result) {
  std::string text =
      fmt::format("## {} lagomorph check: {}\n\n{} against {}: {}.\n\n", result.passed() ? "✅" : "❌",
                  markdown_text(result.name), markdown_text(result.run.string()),
                  markdown_text(result.golden.string()), verdict(result));
  for (const Cause& cause : result.causes) text += "- " + markdown_text(cause.text) + "\n";
  for (const SequenceFinding& finding : result.sequence.findings)
    text += "- " + markdown_text(finding.text) + "\n";
  for (const std::string& remark : result.remarks) text += "- remark: " + markdown_text(remark) + "\n";
  return text + "\n";
}

/// What a workflow command cannot hold as it is.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : one_line(text)) {
    if (c == '%' || c == ':' || c == ',') {
      out += fmt::format("%{:02X}", c);
    } else {
      out += c;
    }
  }
  return out;
}

const char* summary_file() {
  const char* file = std::getenv("GITHUB_STEP_SUMMARY");
  if (file == nullptr || *file == '\0')
    wrong_input("--github: GITHUB_STEP_SUMMARY, where the summary goes, is not set");
  return file;
}

}  // namespace

std::string ctest_measurements(const CheckResult& result) {
  std::string text = measurement("frames", static_cast<double>(result.frames.size()));
  text += measurement("frames_failed", result.failed());
  text += measurement("flip_tile_max",
                      largest(result, [](const render::Figures& f) { return f.flip_tile.mean; }));
  text += measurement("flip_mean", largest(result, [](const render::Figures& f) { return f.flip_mean; }));
  text += measurement("max_abs",
                      largest(result, [](const render::Figures& f) { return f.differences.largest(); }));
  for (const FrameResult* frame : worst_first(result)) {
    if (frame->panel.empty()) continue;
    text += fmt::format(
        "<CTestMeasurementFile type=\"image/png\" name=\"frame {}: golden, new, "
        "heat\">{}</CTestMeasurementFile>\n",
        frame->frame, xml_text(fs::absolute(result.out / frame->panel).lexically_normal().string()));
    break;
  }
  return text;
}

std::string github_summary(const CheckResult& result, std::size_t room) {
  std::string text = summary_head(result);
  if (text.size() > room) return "";
  const std::vector<const FrameResult*> worst = worst_first(result);
  if (worst.empty()) return text;
  const std::string head =
      "| frame | why | FLIP, tile | FLIP, mean | accept it |\n|---:|---|---:|---:|---|\n";
  const auto left_out = [&](std::size_t n) { return fmt::format("\n…and {} more failing frames.\n", n); };
  const std::size_t reserve = left_out(worst.size()).size();
  if (text.size() + head.size() + reserve > room) return text;
  text += head;
  std::size_t told = 0;
  for (const FrameResult* frame : worst) {
    const std::string row = summary_row(result, *frame);
    if (text.size() + row.size() + reserve > room) break;
    text += row;
    ++told;
  }
  if (told < worst.size()) text += left_out(worst.size() - told);
  return text;
}

std::string github_annotations(const CheckResult& result) {
  const std::vector<const FrameResult*> worst = worst_first(result);
  std::string text;
  for (std::size_t i = 0; i < std::min(worst.size(), most_annotations); ++i) {
    const bool last = i + 1 == most_annotations && worst.size() > most_annotations;
    const std::string more =
        last ? fmt::format(" (and {} more frames)", worst.size() - most_annotations) : "";
    text += fmt::format("::error title=frame {} of {}::{}{}\n", worst[i]->frame, escaped(result.name),
                        escaped(worst[i]->failures.front().line()), more);
  }
  return text;
}

void require_github_summary() { summary_file(); }

void append_github_summary(const CheckResult& result) {
  const char* file = summary_file();
  std::error_code error;
  const std::uintmax_t there = fs::exists(file, error) ? fs::file_size(file, error) : 0;
  const std::size_t room =
      there < most_summary_bytes ? most_summary_bytes - static_cast<std::size_t>(there) : 0;
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << github_summary(result, room) << std::flush;
  if (!out)
    throw Error(ExitStatus::machine,
                fmt::format("{}: cannot be appended to: {}", file, std::strerror(errno)));
}

}  // namespace lagomorph::apps
