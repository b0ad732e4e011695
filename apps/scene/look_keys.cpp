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
