#include "apps/scene/overlay_keys.h"

namespace lagomorph::apps {
namespace {

std::vector<std::string> line_sources() { return {"surface", "tets"}; }
std::vector<std::string> hidden_line_styles() { return {"none", "faint", "dashed", "all"}; }

}  // namespace

void visit_wireframe(WireframeDesc& w, KeyVisitor& v) {
  v.key({.name = "show", .meaning = "whether they are drawn"}, &w.show);
  v.key({.name = "of",
         .meaning = "surface: along the edges of what is drawn; tets: of the tets' boundary",
         .choices = line_sources},
        &w.of);
  v.key({.name = "color", .bounds = between(0, 1), .meaning = "linear RGB"}, &w.color);
  v.key({.name = "width", .unit = "pixels", .bounds = above_up_to(0, 100), .meaning = "of the lines"},
        &w.width);
  v.key({.name = "opacity", .bounds = between(0, 1), .meaning = "of the lines"}, &w.opacity);
  v.key({.name = "hidden",
         .meaning = "lines behind something: not drawn, faint, dashed, or all like those in front",
         .choices = hidden_line_styles},
        &w.hidden);
}

void visit_clip(ClipDesc& c, KeyVisitor& v) {
  v.key({.name = "point", .unit = "m", .meaning = "a point of the plane", .required = true}, &c.point);
  v.key({.name = "normal",
         .meaning = "towards the tets that are kept, by their centroids at rest; of any length but 0",
         .required = true},
        &c.normal);
  v.key(
      {.name = "color",
       .bounds = between(0, 1),
       .meaning = "linear RGB of the cut, in place of base_color; of a body that shows a field the field's"},
      &c.color);
}

}  // namespace lagomorph::apps
