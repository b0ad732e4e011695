#pragma once

#include <vector>

namespace lagomorph::apps {

/// Round numbers from at or below `low` to at or above `high`, some `steps` or fewer apart; low < high.
std::vector<double> ticks(double low, double high, int steps = 4);

/// Powers of ten from at or below `low` to at or above `high`, every so many-th where there are many;
/// 0 < low <= high.
std::vector<double> decade_ticks(double low, double high);

}  // namespace lagomorph::apps
