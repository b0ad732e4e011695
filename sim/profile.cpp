#include "sim/profile.h"

namespace lagomorph::sim {

std::string_view to_string(Stage stage) {
  switch (stage) {
    case Stage::energy:
      return "energy";
    case Stage::gradient:
      return "gradient";
    case Stage::hessian:
      return "hessian";
    case Stage::analysis:
      return "analysis";
    case Stage::factorization:
      return "factorization";
    case Stage::solve:
      return "solve";
    case Stage::simulation:
      return "simulation";
    case Stage::surface:
      return "surface";
    case Stage::draw:
      return "draw";
    case Stage::read_back:
      return "read_back";
    case Stage::overlays:
      return "overlays";
    case Stage::encode:
      return "encode";
    case Stage::write:
      return "write";
    case Stage::wait_to_simulate:
      return "wait_to_simulate";
    case Stage::wait_to_draw:
      return "wait_to_draw";
    case Stage::wait_to_write:
      return "wait_to_write";
    case Stage::count:
      break;
  }
  return "";
}

Profile& profile() {
  static Profile of_process;
  return of_process;
}

}  // namespace lagomorph::sim
