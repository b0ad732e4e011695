#include "sim/materials/presets.h"

#include "sim/error.h"

namespace lagomorph::sim {

const std::vector<Preset>& presets() {
  static const std::vector<Preset> rows = {
      {"rubber", 2e6, 0.49, 930.0, "natural rubber, unfilled: 1.5 to 2.5 MPa",
       "Ashby, Materials Selection in Mechanical Design, appendix"},
      {"jelly", 6e3, 0.49, 1000.0, "gelatine, 3 %: shear modulus 2.0 kPa",
       "Nguyen et al. 2014, Ultrasound Med. Biol. 40(1)"},
      {"muscle", 12e3, 0.49, 1050.0, "relaxed muscle of the mouse: 12 kPa",
       "Engler et al. 2004, J. Cell Biol. 166(6); density ICRU Report 44"},
      {"fat", 3.25e3, 0.49, 950.0, "adipose breast tissue: 3.25 kPa",
       "Samani, Zubovits, Plewes 2007, Phys. Med. Biol. 52(6); density ICRU Report 44"},
      {"silicone", 1.32e6, 0.49, 1030.0, "Sylgard 184 cured at 25 °C: 1.32 MPa",
       "Johnston et al. 2014, J. Micromech. Microeng. 24(3)"},
  };
  return rows;
}

std::vector<std::string> material_preset_names() {
  std::vector<std::string> names = {"none"};
  for (const Preset& p : presets()) names.emplace_back(p.name);
  return names;
}

const Preset* find_preset(const std::string& name, const std::string& where) {
  if (name == "none") return nullptr;
  std::string names = "none";
  for (const Preset& p : presets()) {
    if (name == p.name) return &p;
    names += std::string(", ") + p.name;
  }
  throw InputError(where + ": unknown preset '" + name + "'; valid ones are " + names);
}

}  // namespace lagomorph::sim
