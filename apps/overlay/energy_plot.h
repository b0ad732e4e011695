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

/// Ranges of the axes: [s], [J].
struct EnergyAxes {
  std::array<double, 2> time = {0.0, 1.0}, energy = {0.0, 1.0};
};

/// Takes room for the plate of a small diagram at a place as a caption's; none where there is not enough.
std::optional<Rectangle> place_energy_plot(OverlayLayout&, const EnergyAxes&, const std::string& place);

/// Draws energies over time on that plate.
void draw_energy_plot(render::Picture&, const std::vector<EnergySample>&, const EnergyAxes&,
                      const Rectangle& plate);

}  // namespace lagomorph::apps
