#include "apps/check/report_html.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/check/result_text.h"
#include "apps/file_io.h"
#include "apps/frame_ranges.h"
#include "apps/page/chart.h"
#include "apps/page/html.h"
#include "apps/page/style.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_told = 1000;  // failing frames with all their rules

const ReportPictures* find(const std::vector<ReportPictures>& all, int frame) {
  const auto found = std::find_if(all.begin(), all.end(), [=](const auto& p) { return p.frame == frame; });
  return found == all.end() ? nullptr : &*found;
}

std::string list_html(const std::vector<std::string>& lines, const char* kind) {
  if (lines.empty()) return "";
  std::string html = fmt::format("<ul class=\"{}\">", kind);
  for (const std::string& line : lines) html += fmt::format("<li>{}</li>", html_text(line));
  return html + "</ul>";
}

/// What came before any pixel, then what is seen over the frames.
std::string why_html(const CheckResult& result) {
  if (result.passed()) return "";
  std::string html = "<section class=\"card why\"><h2>Why</h2>";
  if (result.causes.empty() && result.sequence.findings.empty())
    return html +
           "<p>Neither run.json nor the sequence tells a cause; the pictures below are all there "
           "is.</p></section>\n";
  html += "<ul>";
  for (const Cause& cause : result.causes)
    html += fmt::format("<li><b>{}</b> {}</li>", html_text(cause.kind), html_text(cause.text));
  for (const SequenceFinding& finding : result.sequence.findings)
    html += fmt::format("<li><b>sequence</b> {}</li>", html_text(finding.text));
  return html + "</ul></section>\n";
}

std::string header_html(const CheckResult& result) {
  const bool passed = result.passed();
  std::string html =
      fmt::format("<header><h1>{} <span class=\"{}\">{}</span></h1></header>\n", html_text(result.name),
                  passed ? "good" : "bad", passed ? "matches its golden" : "differs from its golden");
  html += why_html(result);
  std::vector<int> bad;
  for (const FrameResult& frame : result.frames) {
    if (!frame.passed()) bad.push_back(frame.frame);
  }
  html += fmt::format("<p class=\"verdict\">{}{}.</p>\n", html_text(verdict_text(result)),
                      bad.empty() ? std::string() : fmt::format(": frames {}", ranges_text(bad)));
  return html + list_html(result.remarks, "remarks");
}

std::string rules_html(const FrameResult& frame) {
  std::string html = "<ul class=\"rules\">";
  for (const CheckFailure& f : frame.failures) {
    html += fmt::format("<li><b>{}</b> {}", html_text(f.rule), html_text(f.found));
    if (!f.limit.empty()) html += fmt::format(", limit <b>{}</b>", html_text(f.limit));
    if (!f.from.empty()) html += fmt::format(" <i>by {}</i>", html_text(f.from));
    html += "</li>";
  }
  for (const std::string& hint : frame.hints)
    html += fmt::format("<li class=\"hint\">{}</li>", html_text(hint));
  return html + "</ul>";
}

std::string commands_html(const CheckResult& result, int frame) {
  const FrameCommands commands = frame_commands(result, frame);
  return fmt::format(
      "<dl class=\"commands\"><div><dt>reproduce</dt><dd><code>{}</code></dd></div><div><dt>draw "
      "anew</dt><dd><code>{}</code></dd></div><div><dt>approve, if it is "
      "right</dt><dd><code>{}</code></dd></div></dl>",
      html_text(commands.reproduce), html_text(commands.rerender), html_text(commands.approve));
}

std::string picture_html(const std::string& uri, const char* what, const char* label, int frame) {
  if (uri.empty()) return "";
  return fmt::format(
      "<figure><a href=\"#frame={3}\"><img class=\"{1}\" alt=\"frame {3}, {2}\" src=\"{0}\"></a>"
      "<figcaption>{2}</figcaption></figure>",
      uri, what, label, frame);
}

/// golden | new | heat
std::string pictures_html(const ReportPictures* p, int frame) {
  if (p == nullptr) return "";
  const std::string note =
      p->smaller > 1 ? fmt::format("<p class=\"note\">{} by {}; shown smaller</p>", p->width, p->height) : "";
  return fmt::format(
      "<div class=\"triple\" data-pictures=\"{}\" data-width=\"{}\" data-height=\"{}\">{}{}{}</div>{}", frame,
      p->width, p->height, picture_html(p->golden, "golden", "golden", frame),
      picture_html(p->fresh, "new", p->golden.empty() ? "new, the golden is the same or missing" : "new",
                   frame),
      picture_html(p->heat, "heat", "FLIP's error: black none, white most", frame), note);
}

std::string failing_html(const CheckResult& result, const std::vector<ReportPictures>& pictures) {
  const std::vector<const FrameResult*> worst = worst_first(result);
  std::string large, small;
  std::vector<int> untold;
  bool whole = true;  // the worst at full size come first
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const FrameResult& frame = *worst[i];
    if (i >= most_told) {
      untold.push_back(frame.frame);
      continue;
    }
    const ReportPictures* p = find(pictures, frame.frame);
    whole &= i < 6 && (i == 0 || p == nullptr || p->smaller == 1);
    (whole ? large : small) += fmt::format(
        "<article class=\"card frame\" id=\"f{0}\"><h3>frame {0}</h3>{1}{2}{3}</article>\n", frame.frame,
        rules_html(frame), pictures_html(p, frame.frame), commands_html(result, frame.frame));
  }
  std::string html;
  if (!large.empty()) html += "<h2>Worst frames</h2>" + large;
  if (!small.empty()) html += "<h2>Other frames that fail</h2><div class=\"small\">" + small + "</div>\n";
  if (!untold.empty()) {
    std::sort(untold.begin(), untold.end());
    html += fmt::format("<p>Frames {} fail too; report.json tells how.</p>\n", ranges_text(untold));
  }
  return html;
}

std::string passing_html(const CheckResult& result, const std::vector<ReportPictures>& pictures) {
  std::string html;
  for (const FrameResult& frame : result.frames) {
    const ReportPictures* p = frame.passed() ? find(pictures, frame.frame) : nullptr;
    if (p == nullptr) continue;
    const std::string how = frame.decided_by == DecidedBy::metrics && frame.figures
                                ? fmt::format("flip_tile_max {:.4g}", frame.figures->flip_tile.mean)
                                : fmt::format("equal by {}", decided_by_name(frame.decided_by));
    html += fmt::format("<article class=\"card frame\"><h3>frame {} <i>{}</i></h3>{}</article>\n",
                        frame.frame, how, pictures_html(p, frame.frame));
  }
  return html.empty() ? "" : "<h2>Frames that pass</h2><div class=\"small\">" + html + "</div>\n";
}

/// The curve that the scrubber runs under: of each frame the figure that decides most often. 1 stands for
/// what cannot be compared.
std::string curve_html(const CheckResult& result) {
  Chart chart{.title = "Largest mean FLIP of a tile",
              .unit = "by frame",
              .frames = {},
              .series = {},
              .fps = 1,
              .x_unit = ""};
  Series tile{"the frame", "s2", {}}, limit{"limit", "s3", {}};
  const auto told = std::find_if(result.limits.begin(), result.limits.end(),
                                 [](const LimitTold& l) { return l.name == "flip_tile_max"; });
  for (const FrameResult& frame : result.frames) {
    chart.frames.push_back(frame.frame);
    tile.values.push_back(frame.figures ? frame.figures->flip_tile.mean : frame.passed() ? 0 : 1);
    if (told != result.limits.end()) limit.values.push_back(told->value);
  }
  chart.series = {tile};
  if (told != result.limits.end()) chart.series.push_back(limit);
  return chart_html(chart);
}

std::string viewer_html(const CheckResult& result) {
  if (result.frames.empty()) return "";
  std::string failing;
  for (const FrameResult& frame : result.frames) {
    if (!frame.passed()) failing += fmt::format("{}{}", failing.empty() ? "" : " ", frame.frame);
  }
  std::string views;
  for (const auto& [name, label] : {std::pair{"side", "Side by side"},
                                    {"slider", "Slider"},
                                    {"blink", "Blink"},
                                    {"diff", "Difference"},
                                    {"heat", "FLIP heat"}})
    views += fmt::format("<button data-view=\"{}\">{}</button>", name, label);
  return fmt::format(
      "<section id=\"viewer\" hidden data-failing=\"{}\"><h2>Look closer</h2><div class=\"card player\">"
      "<div class=\"bar\" id=\"views\">{}</div><div class=\"panes\"><canvas id=\"left\"></canvas><canvas "
      "id=\"right\"></canvas></div><p id=\"what\"></p><output id=\"values\">point at a pixel to read "
      "it</output>"
      "<div class=\"bar\"><button id=\"back\" aria-label=\"one frame back\">◀</button><button id=\"next\" "
      "aria-label=\"one frame on\">▶</button><button id=\"bad\">Next failing</button><label>×<select "
      "id=\"times\" "
      "aria-label=\"difference times\"><option>1<option>2<option>4<option "
      "selected>8<option>16<option>32<option>64"
      "</select></label><button id=\"out\" aria-label=\"zoom out\">−</button><button id=\"in\" "
      "aria-label=\"zoom "
      "in\">+</button><button id=\"fit\">Fit</button><output id=\"where\"></output></div>"
      "<input id=\"scrub\" type=\"range\" min=\"0\" max=\"{}\" value=\"0\" step=\"1\" "
      "aria-label=\"frame\"></div>"
      "<p class=\"keys\"><kbd>←</kbd> <kbd>→</kbd> step, <kbd>n</kbd> next failing, "
      "<kbd>1</kbd>–<kbd>5</kbd> views, "
      "<kbd>+</kbd> <kbd>−</kbd> <kbd>0</kbd> zoom, <kbd>[</kbd> <kbd>]</kbd> difference, wheel zooms, drag "
      "moves</p></section>\n",
      failing, views, result.frames.size() - 1);
}

std::string facts_html(const CheckResult& result) {
  std::string html = "<h2>What was held against what</h2><dl class=\"card wide\">";
  const auto fact = [&](const char* label, const std::string& value) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", label, html_text(value));
  };
  fact("run", result.run.string());
  fact("golden", result.golden.string());
  fact("preset", result.preset);
  fact("pixels per degree", fmt::format("{:.6g}", result.pixels_per_degree));
  for (const LimitTold& limit : result.limits)
    fact("limit", fmt::format("{} {} {:.6g} by {}", limit.name, limit.least ? "at least" : "at most",
                              limit.value, limit.from));
  fact("seconds", fmt::format("{:.2f}", result.seconds));
  return html + "</dl>\n";
}

/// Styles of single elements as classes, for policies that forbid them too.
void take_styles(std::string& html, std::string& css) {
  constexpr std::string_view mark = " style=\"";
  std::string out;
  std::size_t at = 0, n = 0;
  for (std::size_t next = 0; (next = html.find(mark, at)) != std::string::npos;) {
    const std::size_t end = html.find('"', next + mark.size());
    css += fmt::format(".p{}{{{}}}\n", n, html.substr(next + mark.size(), end - next - mark.size()));
    out += html.substr(at, next - at) + fmt::format(" class=\"p{}\"", n++);
    at = end + 1;
  }
  html = out + html.substr(at);
}

std::string whole_page(const CheckResult& result, const std::string& head, const std::string& body,
                       const std::string& foot) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}: {}</title>\n<meta "
      "name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">{}</head>\n<body><main>\n{}</main>\n{}"
      "</body></html>\n",
      html_text(result.name), html_text(verdict_text(result)), head, body, foot);
}

std::string body_html(const CheckResult& result, const std::vector<ReportPictures>& pictures) {
  std::string body = header_html(result) + failing_html(result, pictures);
  if (result.frames.size() > 1) body += "<div class=\"curve\">" + curve_html(result) + "</div>";
  body += viewer_html(result) + passing_html(result, pictures) + facts_html(result);
  return body + "<footer>Made by lagomorph check.</footer>\n";
}

}  // namespace

std::string report_html(const CheckResult& result, const std::vector<ReportPictures>& pictures) {
  return whole_page(result, fmt::format("<style>{}{}</style>", page_style, report_style),
                    body_html(result, pictures), fmt::format("<script>{}</script>", report_script));
}

void write_report_html(const CheckResult& result, bool assets) {
  const fs::path folder = result.out / "report_files";
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) remove_file(entry.path());
  if (!assets) {
    const auto pictures =
        report_pictures(result, [](const std::string&, std::string_view type, const std::string& bytes) {
          return data_uri(type, bytes);
        });
    write_file(result.out / "report.html", report_html(result, pictures));
    return;
  }
  make_folder(folder);
  const auto pictures =
      report_pictures(result, [&](const std::string& name, std::string_view, const std::string& bytes) {
        write_file(folder / name, bytes);
        return fmt::format("report_files/{}", name);
      });
  std::string body = body_html(result, pictures);
  std::string css = std::string(page_style) + std::string(report_style);
  take_styles(body, css);
  write_file(folder / "report.css", css);
  write_file(folder / "report.js", report_script);
  write_file(result.out / "report.html",
             whole_page(result, "<link rel=\"stylesheet\" href=\"report_files/report.css\">", body,
                        "<script src=\"report_files/report.js\"></script>"));
}

}  // namespace lagomorph::apps
