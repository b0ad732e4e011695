#include "apps/run/energy_csv.h"

#include <fmt/format.h>

namespace lagomorph::apps {

std::string energy_csv(const std::map<int, FrameRecord>& frames) {
  std::string text =
      "frame,time,kinetic,elastic,gravitational,total,mass,momentum_x,momentum_y,momentum_z,"
      "newton_iterations,residual,work_pins,work_loads,pin_force_x,pin_force_y,pin_force_z,"
      "angular_momentum_x,angular_momentum_y,angular_momentum_z,min_J,steps,rejected,damping_loss\n";
  double work_pins = 0.0, work_loads = 0.0,
         damping_loss = 0.0;  // since frame 0, added up in the order of the frames
  for (const auto& [frame, record] : frames) {
    if (!record.state) continue;
    const StateRecord& s = *record.state;
    damping_loss += s.report.damping_loss;
    text += fmt::format("{}", frame);
    for (const double value : {s.time, s.energy.kinetic, s.energy.elastic, s.energy.gravitational,
                               s.energy.total(), s.mass, s.momentum.x(), s.momentum.y(), s.momentum.z()}) {
      text += fmt::format(",{:.17g}", value);
    }
    text += fmt::format(",{},{:.17g}", s.report.newton_iterations, s.report.residual);
    work_pins += s.report.work_pins;
    work_loads += s.report.work_loads;
    sim::Vec3 pins = sim::Vec3::Zero();
    for (const sim::Vec3& force : s.report.pin_forces) pins += force;
    const sim::Vec3& L = s.angular_momentum;
    for (const double value :
         {work_pins, work_loads, pins.x(), pins.y(), pins.z(), L.x(), L.y(), L.z(), s.min_J}) {
      text += fmt::format(",{:.17g}", value);
    }
    text += fmt::format(",{},{},{:.17g}\n", s.report.steps, s.report.rejected, damping_loss);
  }
  return text;
}

}  // namespace lagomorph::apps
