#include "apps/scene/choices.h"

namespace lagomorph::apps {

std::vector<std::string> material_choices() {
  return {"neo_hookean", "stable_neo_hookean", "stable_neo_hookean_log"};
}
std::vector<std::string> integrator_choices() { return {"backward_euler", "linearly_implicit_euler"}; }
std::vector<std::string> mass_choices() { return {"consistent", "lumped"}; }
std::vector<std::string> hessian_choices() { return {"auto", "projected"}; }
std::vector<std::string> tone_curve_choices() { return {"pbr_neutral"}; }
std::vector<std::string> filter_choices() { return {"box", "gaussian", "blackman_harris"}; }

}  // namespace lagomorph::apps
