#pragma once

#include <functional>

#include "sim/settings.h"

namespace lagomorph::apps {

/// A material's stresses as text books have them, in the stretches, written down apart from the code that
/// simulates: what `lagomorph material` shows beside it. First Piola-Kirchhoff stresses. [Pa]
struct ClosedForm {
  std::function<sim::Vec3(const sim::Vec3&)> principal;  // P_11, P_22, P_33 at F = diag(stretches)
  std::function<double(double)> shear;                   // P_12 at F = 1 + amount e_1 e_2ᵀ
};

/// Of the model without its fibres. Throws InputError for an unknown model or wrong parameters.
ClosedForm closed_form(const sim::MaterialSettings&);

}  // namespace lagomorph::apps
