#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/overlay/layout.h"
#include "apps/overlay/overlay.h"

namespace lagomorph::apps {

/// The energies of a state. [s], [J]
struct EnergySample {
  double time = 0.0;
  double kinetic = 0.0, elastic = 0.0, gravitational = 0.0, total = 0.0;
};

/// Names of the curves, in the order of the legend: kinetic, elastic, gravitational, total.
std::vector<std::string> energy_curves();
/// The value of one of them.
double energy_of(const EnergySample&, const std::string& curve);

/// Ranges of the axes [s], [J], and the curves.
struct EnergyAxes {
  std::array<double, 2> time = {0.0, 1.0}, energy = {0.0, 1.0};
  bool given = false;  // the range of energies, which then is not widened to round numbers
  std::vector<std::string> curves = energy_curves();
};

/// Takes room for the plate of a small diagram at a place as a caption's; none where there is not enough.
std::optional<Rectangle> place_energy_plot(OverlayLayout&, const EnergyAxes&, const std::string& place);

/// Draws energies over time on that plate.
void draw_energy_plot(render::Picture&, const std::vector<EnergySample>&, const EnergyAxes&,
                      const Rectangle& plate);

}  // namespace lagomorph::apps
