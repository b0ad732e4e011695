#pragma once

#include <string>
#include <vector>

#include "apps/material/closed_forms.h"
#include "sim/materials/table.h"

namespace lagomorph::apps {

struct LoadPoint {
  double stretch;       // prescribed; of shear its amount
  double free_stretch;  // across the load, where the stress must vanish; 1 where nothing is free
  double stress;        // first Piola-Kirchhoff, of the direction that is loaded [Pa]
  double closed_form;   // the same of the closed form [Pa]
};

/// Stress against stretch of one kind of loading.
struct LoadCurve {
  const char* loading;            // uniaxial, biaxial, shear, volumetric
  const char* deformation;        // what is prescribed
  const char* stress;             // what is shown
  bool free_sides;                // whether free_stretch means something
  std::vector<LoadPoint> points;  // ascending; points without an equilibrium are NaN in all but the stretch
};

/// Of a material without fibres: uniaxial with free sides, biaxial with a free thickness, simple shear and
/// volumetric. Free stretches are found by Newton's method, from rest outwards.
std::vector<LoadCurve> load_curves(const sim::MaterialPoint&, const ClosedForm&);

}  // namespace lagomorph::apps
