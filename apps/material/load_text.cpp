#include "apps/material/load_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lagomorph::apps {
namespace {

std::string number(double x, const char* otherwise) {
  return std::isfinite(x) ? fmt::format("{:.17g}", x) : otherwise;
}

/// Largest difference from the closed form as a fraction of the largest stress.
double largest_difference(const LoadCurve& curve) {
  double difference = 0.0, stress = 0.0;
  for (const LoadPoint& p : curve.points) {
    if (!std::isfinite(p.stress)) continue;
    difference = std::max(difference, std::abs(p.stress - p.closed_form));
    stress = std::max(stress, std::abs(p.closed_form));
  }
  return stress > 0.0 ? difference / stress : difference;
}

}  // namespace

std::string load_text(const std::string& model, const std::vector<LoadCurve>& curves) {
  std::string text = model + ": first Piola-Kirchhoff stress [Pa]\n";
  for (const LoadCurve& curve : curves) {
    text += fmt::format("\n{}: closed form met to {:.1e} of the largest stress\n", curve.loading,
                        largest_difference(curve));
    text += fmt::format("  {:>8}  {:>12}  {:>18}  {:>14}\n", curve.deformation,
                        curve.free_sides ? "free stretch" : "", curve.stress, "closed form");
    for (const LoadPoint& p : curve.points) {
      const double tenths = 10.0 * p.stretch;
      if (std::abs(tenths - std::round(tenths)) > 1e-6) continue;
      if (!std::isfinite(p.stress)) {
        text += fmt::format("  {:>8.2f}  no stable equilibrium\n", p.stretch);
        continue;
      }
      text +=
          fmt::format("  {:>8.2f}  {:>12}  {:>18.6g}  {:>14.6g}\n", p.stretch,
                      curve.free_sides ? fmt::format("{:.6f}", p.free_stretch) : "", p.stress, p.closed_form);
    }
  }
  return text;
}

std::string load_csv(const std::vector<LoadCurve>& curves) {
  std::string text = "loading,stretch,free_stretch,stress,closed_form\n";
  for (const LoadCurve& curve : curves)
    for (const LoadPoint& p : curve.points)
      text += fmt::format("{},{:.17g},{},{},{}\n", curve.loading, p.stretch, number(p.free_stretch, ""),
                          number(p.stress, ""), number(p.closed_form, ""));
  return text;
}

std::string load_json(const std::string& model, const std::vector<LoadCurve>& curves) {
  std::string text = fmt::format("{{\"model\": \"{}\", \"curves\": {{", model);
  for (const LoadCurve& curve : curves) {
    const auto column = [&](const char* name, double LoadPoint::*member) {
      std::string values;
      for (const LoadPoint& p : curve.points)
        values += (values.empty() ? "" : ", ") + number(p.*member, "null");
      return fmt::format("\"{}\": [{}]", name, values);
    };
    text +=
        fmt::format("{}\"{}\": {{{}, {}, {}, {}}}", &curve == &curves.front() ? "" : ", ", curve.loading,
                    column("stretch", &LoadPoint::stretch), column("free_stretch", &LoadPoint::free_stretch),
                    column("stress", &LoadPoint::stress), column("closed_form", &LoadPoint::closed_form));
  }
  return text + "}}\n";
}

}  // namespace lagomorph::apps
