#pragma once

#include <string>
#include <vector>

namespace lagomorph::apps {

std::vector<std::string> material_choices();
std::vector<std::string> integrator_choices();
std::vector<std::string> mass_choices();
std::vector<std::string> hessian_choices();
std::vector<std::string> tone_curve_choices();
std::vector<std::string> filter_choices();

}  // namespace lagomorph::apps
