#include "apps/overlay/ticks.h"

#include <cmath>

namespace lagomorph::apps {

std::vector<double> ticks(double low, double high, int steps) {
  const double raw = (high - low) / steps;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = power * (raw / power <= 1 ? 1 : raw / power <= 2 ? 2 : raw / power <= 5 ? 5 : 10);
  std::vector<double> all;
  const auto last = static_cast<int>(std::ceil(high / step - 1e-9));
  for (int i = static_cast<int>(std::floor(low / step + 1e-9)); i <= last; ++i) all.push_back(i * step);
  return all;
}

std::vector<double> decade_ticks(double low, double high) {
  constexpr int most = 8;
  const auto first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
  auto last = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
  if (last == first) ++last;
  const int step = (last - first + most - 1) / most;
  std::vector<double> all;
  for (int exponent = first; exponent < last + step; exponent += step)
    all.push_back(std::pow(10.0, exponent));
  return all;
}

}  // namespace lagomorph::apps
