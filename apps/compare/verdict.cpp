#include "apps/compare/verdict.h"

#include <fmt/format.h>

#include "apps/compare/figures_json.h"

namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string row(const char* label, const std::string& text) {
  return fmt::format("  {:<14}{}\n", label, text);
}

std::string place(const render::Tile& t) {
  return fmt::format("at {},{} ({}x{} pixels)", t.x, t.y, t.width, t.height);
}

std::string figures_text(const render::Figures& f, double pixels_per_degree) {
  const auto& q = f.flip_quartiles;
  std::string text =
      row("FLIP", fmt::format("mean {:.6f}, weighted quartiles {:.6f} {:.6f} {:.6f}, largest {:.6f}",
                              f.flip_mean, q[0], q[1], q[2], f.flip_max));
  text += row("", fmt::format("largest mean of a tile {:.6f} {}; {:.6g} pixels per degree", f.flip_tile.mean,
                              place(f.flip_tile.tile), pixels_per_degree));
  const std::optional<double> psnr = f.differences.psnr();
  text += row("PSNR", psnr ? fmt::format("{:.4f} dB", *psnr) : "infinite: the colours are equal");
  text += row("SSIM", f.ssim ? fmt::format("{:.6f}", *f.ssim) : "none: it needs 11 pixels each way");
  text += row("RMSE", fmt::format("{:.6f} of full scale", f.differences.root_mean_square()));
  text += row("differences",
              fmt::format("{} pixels, the largest {} of {}, mean {:.6f} of full scale", f.differences.pixels,
                          f.differences.most, f.differences.full_scale, f.differences.mean_absolute()));
  if (!f.alpha) return text;
  return text + row("alpha", fmt::format("mean {:.6f}, largest {:.6f}, of a tile {:.6f} {}", f.alpha->mean,
                                         f.alpha->most, f.alpha->tile.mean, place(f.alpha->tile.tile)));
}

}  // namespace

PairVerdict judge_pair(const render::Pixels& a, const render::Pixels& b, double pixels_per_degree) {
  PairVerdict verdict;
  verdict.failures = render::gate_kinds(render::kind_of(a), render::kind_of(b));
  if (a.width != b.width || a.height != b.height) return verdict;
  verdict.comparison = render::compare_pictures(a, b, pixels_per_degree);
  for (render::GateFailure& failure : render::gate_figures(verdict.comparison->figures)) {
    verdict.failures.push_back(std::move(failure));
  }
  return verdict;
}

std::string verdict_json(const PairVerdict& verdict) {
  Json json = {{"same", verdict.same()}};
  if (verdict.comparison) {
    json.update(figures_json(verdict.comparison->figures));
  } else {
    const Json figures = figures_json({});
    for (const auto& [name, value] : figures.items()) json[name] = nullptr;
    json["equal"] = false;
  }
  return json.dump() + "\n";
}

std::string verdict_text(const PairVerdict& verdict, const std::string& a, const std::string& b,
                         double pixels_per_degree) {
  const bool equal = verdict.comparison && verdict.comparison->figures.equal && verdict.same();
  std::string text = fmt::format("{} and {}: {}\n", a, b,
                                 equal            ? "equal"
                                 : verdict.same() ? "the same by the default limits"
                                                  : "different");
  for (const render::GateFailure& failure : verdict.failures) text += row("fails by", failure.line());
  if (verdict.comparison) text += figures_text(verdict.comparison->figures, pixels_per_degree);
  return text;
}

}  // namespace lagomorph::apps
