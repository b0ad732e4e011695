#pragma once

#include <string>
#include <vector>

namespace lagomorph::sim {

/// Moduli of a substance by name, with where they were measured.
struct Preset {
  const char* name;
  double young;      // [Pa]
  double poisson;    // nearly incompressible ones are taken at 0.49
  double density;    // a suggestion [kg/m^3]; a scene's density is its own key
  const char* what;  // what was measured
  const char* source;
};

const std::vector<Preset>& presets();
/// "none" and the names of the presets.
std::vector<std::string> material_preset_names();
/// nullptr for "none"; throws InputError, prefixed by `where`, for an unknown name.
const Preset* find_preset(const std::string& name, const std::string& where);

}  // namespace lagomorph::sim
