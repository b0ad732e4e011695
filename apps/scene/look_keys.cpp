#include "apps/scene/body_keys.h"
#include "render/colormap.h"
#include "sim/fields.h"

namespace lagomorph::apps {

std::vector<std::string> field_choices() {
  std::vector<std::string> names = {"none"};
  for (const sim::FieldInfo& field : sim::field_table()) names.emplace_back(field.name);
  return names;
}

std::vector<std::string> colormap_choices() {
  std::vector<std::string> names = render::colormap_names();
  names.insert(names.begin(), "auto");
  return names;
}

void visit_look(render::Material& m, KeyVisitor& v) {
  v.key({.name = "base_color",
         .bounds = between(0, 1),
         .meaning = "linear RGB: diffuse albedo, or a metal's reflectance at normal incidence"},
        &m.base_color);
  v.key({.name = "roughness", .bounds = between(0, 1), .meaning = "perceptual; GGX alpha is its square"},
        &m.roughness);
  v.key({.name = "metallic",
         .bounds = between(0, 1),
         .meaning = "0 a dielectric over a diffuse base, 1 a metal"},
        &m.metallic);
  v.key({.name = "ior", .bounds = between(1, 10), .meaning = "index of refraction of the dielectric"},
        &m.ior);
}

void visit_shown_field(ShownField& s, KeyVisitor& v) {
  v.key({.name = "field",
         .meaning = "scalar field that colours the surface, in place of base_color",
         .choices = field_choices},
        &s.field);
  v.key({.name = "colormap",
         .meaning = "colours of the field; auto: viridis, of J coolwarm with 1 in its middle",
         .choices = colormap_choices},
        &s.colormap);
  v.key({.name = "range",
         .unit = "of the field",
         .meaning = "values of the first and the last colour; without it the least and the greatest of all "
                    "frames"},
        &s.range);
  v.key({.name = "color_bar", .meaning = "whether a field's colours are told in the picture"}, &s.color_bar);
}

}  // namespace lagomorph::apps
