#pragma once

#include <map>
#include <string>

#include "apps/run/record.h"

namespace lagomorph::apps {

/// energy.csv: a row a frame whose state is there, 17 digits. Energies [J], mass [kg], momentum [kg m/s];
/// of the steps since the frame before: Newton iterations, the largest residual; what pins and loads have
/// done since frame 0 [J], the sum of the pins' forces in the last step [N], the angular momentum about the
/// origin [kg m^2/s], the worst J; steps taken and rejected; the energy that damping took up to the frame
/// [J].
std::string energy_csv(const std::map<int, FrameRecord>& frames);

}  // namespace lagomorph::apps
