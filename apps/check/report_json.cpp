#include "apps/check/report_json.h"

#include <nlohmann/json.hpp>

#include "apps/compare/figures_json.h"
#include "apps/version.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json tile_json(const render::Tile& t) { return {t.x, t.y, t.width, t.height}; }

Json limits_json(const std::vector<LimitTold>& limits) {
  Json json = Json::object();
  for (const LimitTold& limit : limits)
    json[limit.name] = {{limit.least ? "least" : "most", limit.value}, {"from", limit.from}};
  return json;
}

Json failure_json(const CheckFailure& failure) {
  return {{"rule", failure.rule},
          {"found", failure.found},
          {"limit", text_or_null(failure.limit)},
          {"from", text_or_null(failure.from)},
          {"line", failure.line()}};
}

Json all_figures_json(const FrameResult& frame) {
  if (!frame.figures) return nullptr;
  const render::Figures& f = *frame.figures;
  Json json = figures_json(f);
  json["flip_tile"] = tile_json(f.flip_tile.tile);
  json["mean_abs"] = f.differences.mean_absolute();
  json["pixels"] =
      3.0 * static_cast<double>(f.differences.pixels) / static_cast<double>(f.differences.samples);
  if (frame.bias) {
    json["bias_mean"] = frame.bias->mean;
    json["bias_tile_max"] = frame.bias->tile.mean;
    json["bias_tile"] = tile_json(frame.bias->tile.tile);
  }
  if (frame.flicker) {
    json["flicker_mean"] = frame.flicker_mean.value_or(0);
    json["flicker_tile_max"] = frame.flicker->mean;
    json["flicker_tile"] = tile_json(frame.flicker->tile);
  }
  if (frame.light) {
    const render::LightFigures& l = *frame.light;
    json["mc_false_discovery"] = l.false_discovery;
    json["mc_tile"] = tile_json(l.cell);
    json["mc_tile_z"] = l.cell_z;
    json["mc_discoveries"] = l.discoveries;
    json["mc_tiles"] = l.cells;
    json["mc_global_z"] = l.global_z;
    json["mc_global_change"] = l.global_change;
  }
  if (f.alpha) {
    json["alpha"] = {{"mean", f.alpha->mean},
                     {"max", f.alpha->most},
                     {"tile_max", f.alpha->tile.mean},
                     {"tile", tile_json(f.alpha->tile.tile)}};
  }
  return json;
}

Json frame_json(const CheckResult& result, const FrameResult& frame) {
  Json failures = Json::array();
  for (const CheckFailure& failure : frame.failures) failures.push_back(failure_json(failure));
  Json json = {{"frame", frame.frame},
               {"passed", frame.passed()},
               {"decided_by", decided_by_name(frame.decided_by)},
               {"golden", text_or_null(frame.golden.string())},
               {"new", text_or_null(frame.fresh.string())},
               {"new_sha256", text_or_null(frame.fresh_sha256)},
               {"variant", text_or_null(frame.variant)},
               {"failures", failures},
               {"figures", all_figures_json(frame)},
               {"masked", frame.masked},
               {"hints", frame.hints},
               {"heat", text_or_null(frame.heat)},
               {"panel", text_or_null(frame.panel)},
               {"seconds", frame.seconds}};
  if (!frame.passed()) {
    const FrameCommands commands = frame_commands(result, frame.frame);
    json["commands"] = {
        {"reproduce", commands.reproduce}, {"rerender", commands.rerender}, {"approve", commands.approve}};
  }
  return json;
}

}  // namespace

std::string report_json(const CheckResult& result) {
  Json frames = Json::array(), bad = Json::array(), findings = Json::array(), causes = Json::array();
  for (const FrameResult& frame : result.frames) frames.push_back(frame_json(result, frame));
  for (const FrameRange& range : result.sequence.bad) bad.push_back({range.first, range.last});
  for (const SequenceFinding& finding : result.sequence.findings) {
    findings.push_back({{"kind", finding.kind},
                        {"frames", {finding.frames.first, finding.frames.last}},
                        {"text", finding.text}});
  }
  for (const Cause& cause : result.causes) causes.push_back({{"kind", cause.kind}, {"text", cause.text}});
  const Json json = {
      {"format", "lagomorph-check-report"},
      {"version", report_version},
      {"lagomorph", version()},
      {"run", result.run.string()},
      {"golden", result.golden.string()},
      {"name", result.name},
      {"passed", result.passed()},
      {"counts", {{"frames", result.frames.size()}, {"failed", result.failed()}}},
      {"preset", result.preset},
      {"limits", limits_json(result.limits)},
      {"pixels_per_degree", result.pixels_per_degree},
      {"causes", causes},
      {"sequence",
       {{"first_bad", result.sequence.bad.empty() ? Json(nullptr) : Json(result.sequence.bad.front().first)},
        {"bad", bad},
        {"findings", findings}}},
      {"remarks", result.remarks},
      {"seconds", result.seconds},
      {"frames", frames}};
  // Paths and messages may hold bytes that are no UTF-8.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lagomorph::apps
