#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/color.h"

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

/// Draws a small diagram of energies over time on a plate, at a place as a caption's; nothing where the
/// picture is too small. What is there already takes so many pixels: `above` from the border at the top or
/// bottom, `beside` from that at the right.
void draw_energy_plot(render::Picture&, const std::vector<EnergySample>&, const EnergyAxes&,
                      const std::string& place, double above = 0.0, double beside = 0.0);

}  // namespace lagomorph::apps
