#include "apps/preview/page.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/page/chart.h"
#include "apps/page/html.h"
#include "apps/page/style.h"
#include "apps/preview/contact_sheet.h"
#include "apps/preview/story.h"

namespace lagomorph::apps {
namespace {

constexpr std::size_t most_thumbnail_bytes = 1'500'000;

const PageFrame* find(const std::vector<PageFrame>& frames, int frame) {
  const auto found =
      std::find_if(frames.begin(), frames.end(), [=](const PageFrame& f) { return f.frame == frame; });
  return found == frames.end() ? nullptr : &*found;
}

std::string header_html(const PreviewMaterial& m) {
  std::string rest = headline(m).substr(m.name.size() + 2);
  constexpr std::string_view good = "all steps converged";
  rest = html_text(rest);
  if (const std::size_t at = rest.find(good); at != std::string::npos)
    rest.replace(at, good.size(), "<span class=\"good\">all steps converged</span>");
  std::string html = fmt::format("<header><h1>{}</h1><p>{}</p>", html_text(m.name), rest);
  if (!m.remarks.empty()) {
    html += "<ul class=\"remarks\">";
    for (const std::string& remark : m.remarks) html += "<li>" + html_text(remark) + "</li>";
    html += "</ul>";
  }
  return html + "</header>\n";
}

std::string facts_html(const Facts& facts, const char* kind) {
  std::string html = fmt::format("<dl class=\"card {}\">", kind);
  for (const auto& [label, value] : facts)
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", html_text(label), html_text(value));
  return html + "</dl>\n";
}

/// The frame that stands for the whole while nothing moves: past the first third, where something has
/// happened.
const PageFrame& poster(const std::vector<PageFrame>& frames) { return frames[frames.size() / 3]; }

std::string player_html(const Shown& shown, const std::vector<PageFrame>& frames) {
  const PageFrame& first = poster(frames);
  std::string html = fmt::format(
      "<div><div class=\"card player\"><div class=\"stage\"><img id=\"still\" class=\"{}\" data-frame=\"{}\" "
      "width=\"{}\" "
      "height=\"{}\" alt=\"frame {}\" src=\"{}\"></div>",
      shown.size.width < 240 ? "tiny" : "", first.frame, shown.size.width, shown.size.height, first.frame,
      first.uri);
  html += fmt::format(
      "<div class=\"controls\"><input id=\"scrub\" type=\"range\" min=\"0\" max=\"{}\" value=\"0\" "
      "step=\"1\" "
      "aria-label=\"frame\"><button id=\"play\" class=\"play\">Play</button>"
      "<button id=\"back\" aria-label=\"one frame back\">◀</button><button id=\"next\" aria-label=\"one "
      "frame on\">▶</button>"
      "<select id=\"speed\" aria-label=\"speed\"><option value=\"0.1\">0.1×</option><option "
      "value=\"0.25\">0.25×</option>"
      "<option value=\"0.5\">0.5×</option><option value=\"1\" selected>1×</option><option "
      "value=\"2\">2×</option>"
      "<option value=\"4\">4×</option></select><output id=\"where\" class=\"where\"></output></div></div>",
      frames.size() - 1);
  return html +
         "<p class=\"keys\"><kbd>space</kbd> plays, <kbd>←</kbd> <kbd>→</kbd> step, <kbd>Home</kbd> "
         "<kbd>End</kbd> jump, "
         "<kbd>+</kbd> <kbd>−</kbd> change the speed; click a curve to go there</p></div>\n";
}

/// Changes since the first frame: where a body hangs is no news, and gravity's energy would dwarf all else.
std::string energy_chart(const PreviewMaterial& m) {
  Chart chart{
      .title = "Energy", .unit = "change since the first frame, J", .frames = {}, .series = {}, .fps = m.fps};
  chart.series = {
      {"kinetic", "s2", {}}, {"elastic", "s3", {}}, {"gravitational", "s4", {}}, {"total", "s1", {}}};
  const sim::Energies& start = m.records.begin()->second.state->energy;
  for (const auto& [frame, record] : m.records) {
    const sim::Energies& e = record.state->energy;
    chart.frames.push_back(frame);
    chart.series[0].values.push_back(e.kinetic - start.kinetic);
    chart.series[1].values.push_back(e.elastic - start.elastic);
    chart.series[2].values.push_back(e.gravitational - start.gravitational);
    chart.series[3].values.push_back(e.total() - start.total());
  }
  return chart_html(chart);
}

std::string newton_chart(const PreviewMaterial& m) {
  Chart chart{.title = "Newton iterations",
              .unit = "per frame",
              .frames = {},
              .series = {},
              .fps = m.fps,
              .bars = true};
  Series smooth{"whole steps", "s3", {}}, halved{"with halved steps", "s2", {}};
  bool has_halved = false;
  for (const auto& [frame, record] : m.records) {
    const sim::FrameReport& report = record.state->report;
    const bool is_halved = report.halvings > 0;
    has_halved |= is_halved;
    chart.frames.push_back(frame);
    smooth.values.push_back(is_halved ? 0 : report.newton_iterations);
    halved.values.push_back(is_halved ? report.newton_iterations : 0);
  }
  chart.series = {smooth};
  if (has_halved) chart.series.push_back(halved);
  return chart_html(chart);
}

std::string seconds_chart(const PreviewMaterial& m) {
  Chart chart{
      .title = "Time spent", .unit = "per frame, ms", .frames = {}, .series = {}, .fps = m.fps, .bars = true};
  chart.series = {{"simulation", "s3", {}}, {"rendering", "s2", {}}, {"writing", "s4", {}}};
  for (const auto& [frame, record] : m.records) {
    chart.frames.push_back(frame);
    chart.series[0].values.push_back(1000 * record.state->seconds);
    chart.series[1].values.push_back(record.picture ? 1000 * record.picture->rendering_seconds : 0);
    chart.series[2].values.push_back(record.picture ? 1000 * record.picture->writing_seconds : 0);
  }
  return chart_html(chart);
}

std::string charts_html(const PreviewMaterial& m) {
  if (m.records.size() < 2) return "";
  return "<h2>What happened</h2><div class=\"charts\">" + energy_chart(m) + newton_chart(m) +
         seconds_chart(m) + "</div>\n";
}

std::string cell_html(const PreviewMaterial& m, const ShownFrame& frame,
                      const std::vector<PageFrame>& frames) {
  const std::string time = m.info ? fmt::format("<i>{:.2f} s</i>", frame_time(m, frame.frame)) : "";
  const std::string caption = fmt::format("<span>frame {}{}</span>", frame.frame, time);
  const PageFrame* there = find(frames, frame.frame);
  if (there == nullptr) return fmt::format("<li><div class=\"none\">unreadable</div>{}</li>", caption);
  return fmt::format(
      "<li><a href=\"#frame={0}\" data-frame=\"{0}\"><img loading=\"lazy\" alt=\"frame {0}\" "
      "src=\"{1}\">{2}</a></li>",
      frame.frame, there->uri, caption);
}

/// Frames evenly chosen among those that the page holds and those that cannot be read.
std::string sheet_html(const PreviewMaterial& m, const Shown& shown, const std::vector<PageFrame>& frames) {
  std::vector<const ShownFrame*> there;
  for (const ShownFrame& frame : shown.frames) {
    if (frame.small.empty() || find(frames, frame.frame) != nullptr) there.push_back(&frame);
  }
  for (std::size_t most : {20U, 12U, 6U, 2U}) {
    std::string html;
    for (const std::size_t i : evenly(there.size(), most)) html += cell_html(m, *there[i], frames);
    if (html.size() <= most_thumbnail_bytes || most == 2)
      return "<h2>Frames</h2><ul class=\"sheet\">" + html + "</ul>\n";
  }
  return "";
}

/// The frames for the script. URIs are base64, so nothing in them ends the element.
std::string frames_json(const PreviewMaterial& m, const Shown& shown, const std::vector<PageFrame>& frames) {
  std::string list;
  for (const PageFrame& frame : frames) {
    list += (list.empty() ? "" : ",\n") + fmt::format("{{\"n\":{},", frame.frame);
    if (m.info) list += fmt::format("\"t\":{:.6g},", frame_time(m, frame.frame));
    list += "\"src\":\"" + frame.uri + "\"}";
  }
  // As fast as in life, though some frames are left out.
  const double kept = static_cast<double>(frames.size()) /
                      static_cast<double>(std::max<std::size_t>(1, shown.readable().size()));
  return fmt::format(
      "<script id=\"frames\" type=\"application/json\">{{\"rate\":{:.6g},\"frames\":[{}]}}</script>\n",
      picture_rate(m) / shown.every * kept, list);
}

std::string origin_html(const PreviewMaterial& m) {
  if (!m.info) return "";
  std::string html = "<h2>Where it comes from</h2>" + facts_html(environment_facts(m), "wide");
  if (!m.scene.empty()) {
    html += fmt::format(
        "<details class=\"card\"><summary>The scene, with every default written "
        "out</summary><pre>{}</pre></details>\n",
        html_text(m.scene));
  }
  return html;
}

}  // namespace

std::string preview_page(const PreviewMaterial& m, const Shown& shown, const std::vector<PageFrame>& frames) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>\n"
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"><style>{}</style></head>\n<body><main>\n",
      html_text(headline(m)), page_style);
  html += header_html(m);
  const std::string facts = facts_html(run_facts(m, shown), "");
  html += frames.empty() ? facts : "<div class=\"top\">" + player_html(shown, frames) + facts + "</div>\n";
  html += charts_html(m);
  if (frames.size() > 1 || shown.readable().size() < shown.frames.size())
    html += sheet_html(m, shown, frames);
  html += origin_html(m);
  html +=
      "<footer>Made by lagomorph preview. This page is one file and needs no network.</footer>\n</main>\n";
  if (!frames.empty()) html += frames_json(m, shown, frames);
  return html + fmt::format("<script>{}</script></body></html>\n", player_script);
}

}  // namespace lagomorph::apps
