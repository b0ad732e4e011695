#include "apps/run/newton_csv.h"

#include <fmt/format.h>

namespace lagomorph::apps {

std::string newton_csv(const std::map<int, FrameRecord>& frames) {
  std::string rows;
  for (const auto& [frame, record] : frames) {
    if (!record.state) continue;
    for (const sim::NewtonLog& log : record.state->report.newton) {
      int iteration = 0;
      for (const sim::NewtonIterate& at : log.iterates) {
        rows += fmt::format("{},{:.17g},{:.17g},{},{},{:.17g},{:.17g},{:.17g},{:.17g}\n", frame, log.t, log.h,
                            sim::to_string(log.status), iteration++, at.residual, at.energy, at.step,
                            at.clamping);
      }
    }
  }
  return rows.empty() ? "" : "frame,time,h,status,iteration,residual,energy,step,clamping\n" + rows;
}

}  // namespace lagomorph::apps
