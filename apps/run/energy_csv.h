#pragma once

#include <map>
#include <string>

#include "apps/run/record.h"

namespace lagomorph::apps {

/// energy.csv: a row a frame whose state is there, 17 digits. Energies [J], mass [kg], momentum [kg m/s].
std::string energy_csv(const std::map<int, FrameRecord>& frames);

}  // namespace lagomorph::apps
