#include "apps/scene/overlay_keys.h"

#include "apps/overlay/caption.h"
#include "apps/overlay/energy_plot.h"
#include "render/colormap.h"

namespace lagomorph::apps {
namespace {

std::vector<std::string> line_sources() { return {"surface", "tets"}; }
std::vector<std::string> hidden_line_styles() { return {"none", "faint", "dashed", "all"}; }

std::vector<std::string> ghost_styles() { return {"none", "fill", "outline", "both"}; }
std::vector<std::string> load_arrows() { return {"none", "vertices", "total"}; }

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

void visit_ghost(GhostDesc& g, KeyVisitor& v) {
  v.key({.name = "show",
         .meaning = "a translucent fill, its outline (contours and sharp edges), or both",
         .choices = ghost_styles},
        &g.show);
  v.key({.name = "color", .bounds = between(0, 1), .meaning = "linear RGB"}, &g.color);
  v.key({.name = "opacity", .bounds = between(0, 1), .meaning = "of the fill where it is seen from the side"},
        &g.opacity);
  v.key({.name = "over", .meaning = "true: over the bodies; false: hidden behind them"}, &g.over);
}

void visit_labels(LabelsDesc& l, KeyVisitor& v) {
  v.key({.name = "vertices", .meaning = "numbers of the vertices, from 0, as pins select them"}, &l.vertices);
  v.key({.name = "faces", .meaning = "numbers of the triangles, from 0, in the order of the surface"},
        &l.faces);
  v.key({.name = "of",
         .meaning = "tets: of the tets' boundary; surface: of what is drawn",
         .choices = line_sources},
        &l.of);
  v.key({.name = "most",
         .bounds = between(1, 100000),
         .meaning = "of each kind; where there are more, only every second, third, ... has its number"},
        &l.most);
}

void visit_glyphs(GlyphsDesc& g, KeyVisitor& v) {
  v.key({.name = "pins", .meaning = "a dot at each pinned vertex of the surface, a ring where axes are free"},
        &g.pins);
  v.key({.name = "loads",
         .meaning = "arrows of the loads: on each vertex of the surface, or one for each body with its size",
         .choices = load_arrows},
        &g.loads);
  v.key({.name = "gravity", .meaning = "an arrow at each body's centre of mass"}, &g.gravity);
  v.key({.name = "displacement_every",
         .bounds = at_least(0),
         .meaning =
             "arrows from rest to where a vertex is, at every so many-th vertex of the surface; 0: none"},
        &g.displacement_every);
  v.key({.name = "size",
         .unit = "m",
         .bounds = above(0),
         .meaning = "diameter of dots and length of arrows' heads",
         .default_note = "1/55 of the smallest body's diagonal at rest"},
        &g.size);
  v.key({.name = "force",
         .unit = "N",
         .bounds = above(0),
         .meaning = "whose arrow is 1 m long",
         .default_note = "the longest has 0.22 of that diagonal"},
        &g.force);
  v.key({.name = "pin_color", .bounds = between(0, 1), .meaning = "linear RGB"}, &g.pin_color);
  v.key({.name = "load_color", .bounds = between(0, 1), .meaning = "linear RGB"}, &g.load_color);
  v.key({.name = "colormap",
         .meaning = "colours of displacements, from 0 to the largest of all frames",
         .choices = render::colormap_names},
        &g.colormap);
}

void visit_energy_plot(EnergyPlotDesc& p, KeyVisitor& v) {
  v.key({.name = "show", .meaning = "whether it is drawn"}, &p.show);
  v.key({.name = "place", .meaning = "where in the picture", .choices = caption_places}, &p.place);
  v.key({.name = "curves", .meaning = "that are drawn", .choices = energy_curves}, &p.curves);
  v.key({.name = "range",
         .unit = "J",
         .meaning = "of the axis of energies; without it from the least to the greatest of the curves in all "
                    "frames. Beyond it curves are cut off"},
        &p.range);
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

void visit_caption(CaptionDesc& c, KeyVisitor& v) {
  v.key({.name = "text",
         .meaning = "written over each picture, with values as {name}, {frame:04}, {frames}, {time:.2f}, "
                    "{kinetic:.1f}, "
                    "{elastic}, {gravitational}, {total}, {iterations}, {min_J}; empty: nothing"},
        &c.text);
  v.key({.name = "place", .meaning = "where in the picture", .choices = caption_places}, &c.place);
}

}  // namespace lagomorph::apps
