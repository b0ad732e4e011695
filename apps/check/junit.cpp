#include "apps/check/junit.h"

#include <fmt/format.h>

#include "apps/frame_ranges.h"
#include "apps/one_line.h"
#include "apps/utf8.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

std::string attachment(const fs::path& file, const fs::path& from) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  const fs::path relative = whole.lexically_relative(fs::absolute(from).lexically_normal());
  const bool inside = !relative.empty() && *relative.begin() != "..";
  return fmt::format("[[ATTACHMENT|{}]]\n", (inside ? relative : whole).string());
}

/// Why the frame fails, a line a rule, then what it looks like.
std::string body_of(const FrameResult& frame) {
  std::string text;
  for (const CheckFailure& failure : frame.failures) text += one_line(failure.line()) + "\n";
  for (const std::string& hint : frame.hints) text += one_line(hint) + "\n";
  return text;
}

std::string system_out(const CheckResult& result, const FrameResult& frame, const fs::path& from) {
  std::string text;
  if (!frame.panel.empty()) text += attachment(result.out / frame.panel, from);
  for (const fs::path& file : {frame.golden, frame.fresh}) {
    std::error_code none;
    if (!file.empty() && fs::is_regular_file(file, none)) text += attachment(file, from);
  }
  if (!frame.heat.empty()) text += attachment(result.out / frame.heat, from);
  const FrameCommands commands = frame_commands(result, frame.frame);
  return text + fmt::format("{}\n{}\n{}\n", commands.reproduce, commands.rerender, commands.approve);
}

std::string case_xml(const CheckResult& result, const FrameResult& frame, const fs::path& from) {
  std::string xml = fmt::format("  <testcase classname=\"check.{}\" name=\"frame {:04}\" time=\"{:.6f}\"",
                                xml_text(result.name), frame.frame, frame.seconds);
  if (frame.passed()) return xml + "/>\n";
  const std::string message = one_line(frame.failures.front().line());
  return xml + fmt::format(
                   ">\n   <failure type=\"{}\" message=\"{}\">{}</failure>\n   <system-out>{}</system-out>\n"
                   "  </testcase>\n",
                   xml_text(frame.failures.front().rule), xml_text(message), xml_text(body_of(frame)),
                   xml_text(system_out(result, frame, from)));
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : valid_utf8(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') out += c;
    }
  }
  return out;
}

std::string junit_xml(const CheckResult& result, const fs::path& from) {
  double seconds = 0;
  std::string cases;
  for (const FrameResult& frame : result.frames) {
    seconds += frame.seconds;
    cases += case_xml(result, frame, from);
  }
  const std::string counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\" time=\"{:.6f}\"",
                  result.frames.size(), result.failed(), seconds);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"lagomorph check\" {0}>\n"
      " <testsuite name=\"{1}\" {0}>\n{2} </testsuite>\n</testsuites>\n",
      counts, xml_text(result.name), cases);
}

}  // namespace lagomorph::apps
