#include "apps/run/energy_csv.h"

#include <fmt/format.h>

namespace lagomorph::apps {

std::string energy_csv(const std::map<int, FrameRecord>& frames) {
  std::string text =
      "frame,time,kinetic,elastic,gravitational,total,mass,momentum_x,momentum_y,momentum_z,"
      "newton_iterations,residual\n";
  for (const auto& [frame, record] : frames) {
    if (!record.state) continue;
    const StateRecord& s = *record.state;
    text += fmt::format("{}", frame);
    for (const double value : {s.time, s.energy.kinetic, s.energy.elastic, s.energy.gravitational,
                               s.energy.total(), s.mass, s.momentum.x(), s.momentum.y(), s.momentum.z()}) {
      text += fmt::format(",{:.17g}", value);
    }
    text += fmt::format(",{},{:.17g}\n", s.report.newton_iterations, s.report.residual);
  }
  return text;
}

}  // namespace lagomorph::apps
