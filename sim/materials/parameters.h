#pragma once

#include <string>

#include "sim/settings.h"

namespace lagomorph::sim {

/// Lamé's constants. [Pa]
struct Lame {
  double mu = 0.0;
  double lambda = 0.0;
};

/// mu = E/(2(1+nu)), lambda = E nu/((1+nu)(1-2nu)).
Lame lame_from_young(double young, double poisson);

/// (mu, lambda) of a material that takes (young, poisson) or (mu, lambda), with the preset or the defaults
/// filled in and everything checked: mu > 0 and a bulk modulus lambda + 2mu/3 > 0. Throws InputError prefixed
/// by `where`.
Lame lame_parameters(const MaterialSettings&, const std::string& where);

}  // namespace lagomorph::sim
