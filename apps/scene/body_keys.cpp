#include "apps/scene/body_keys.h"

#include "apps/scene/overlay_keys.h"
#include "sim/start.h"

namespace lagomorph::apps {
namespace {

constexpr Part simulation = Part::simulation;

std::vector<std::string> mass_choices() { return {"consistent", "lumped"}; }
std::vector<std::string> element_choices() { return {"mesh", "linear", "quadratic"}; }

void visit_surface(SurfaceDesc& s, KeyVisitor& v) {
  v.key({.name = "mesh",
         .meaning =
             "fine surface to embed (.obj, .off, .ply, .stl), placed as the body is; empty: the boundary "
             "of the tets",
         .file = true},
        &s.mesh);
  v.key({.name = "max_outside",
         .bounds = at_least(0),
         .meaning = "how far a fine vertex may lie outside of the tets, as a fraction of the body's "
                    "bounding-box diagonal"},
        &s.max_outside);
  v.key({.name = "subdivide",
         .bounds = between(0, 4),
         .meaning =
             "times the tets' boundary or the fine mesh is subdivided by Loop's scheme, each into four times "
             "the triangles: a smooth surface of a coarse mesh"},
        &s.subdivide);
  v.key({.name = "smooth", .meaning = "smooth normals; false: one a triangle"}, &s.smooth);
  v.key(
      {.name = "flip", .meaning = "its other side is the outside: for meshes whose triangles are inside out"},
      &s.flip);
  v.key({.name = "fill",
         .meaning = "false: nothing of the surface but its wireframe is drawn, and it has no shadow"},
        &s.fill);
  v.key(
      {.name = "face_orientation",
       .meaning = "its outside is blue and its inside red, in place of colour and field; both are lit alike"},
      &s.face_orientation);
}

void visit_body_look(BodyDesc& b, KeyVisitor& v) {
  visit_look(b.look, v);
  visit_optics(b.look, v);
  visit_shown_field(b.shown, v);
}

}  // namespace

void visit_body(BodyDesc& b, KeyVisitor& v) {
  sim::BodySettings& p = b.physics;
  v.key({.name = "name",
         .part = simulation,
         .meaning = "of the body, in messages and files",
         .default_note = "body0, body1, ..."},
        &p.name);
  v.key({.name = "mesh",
         .part = simulation,
         .meaning = "tet mesh (.mesh, .msh, .node or .ele, .vtk, .vtu), relative to the scene file",
         .required = true,
         .file = true},
        &b.mesh);
  v.key({.name = "element",
         .part = simulation,
         .meaning =
             "mesh: tets of 4 or 10 nodes as the file has them; linear, quadratic: made so as it is read. "
             "Quadratic ones do not lock near poisson 0.5",
         .choices = element_choices},
        &b.element);
  v.key({.name = "density",
         .unit = "kg/m^3",
         .bounds = above(0),
         .part = simulation,
         .meaning = "mass density at rest"},
        &p.density);
  v.key({.name = "mass", .part = simulation, .meaning = "mass matrix", .choices = mass_choices}, &p.mass);
  v.key({.name = "scale",
         .bounds = above(0),
         .part = simulation,
         .meaning = "the rest shape is placed at translate + rotate(scale X)"},
        &p.scale);
  v.key({.name = "rotate",
         .unit = "degrees",
         .part = simulation,
         .meaning = "about the fixed x, then y, then z axis"},
        &p.rotate);
  v.key({.name = "translate", .unit = "m", .part = simulation, .meaning = "of the rest shape"}, &p.translate);
  v.key({.name = "velocity",
         .unit = "m/s",
         .part = simulation,
         .meaning = "at the start, of the whole body; pinned vertices start with that of their motion"},
        &p.velocity);
  v.key({.name = "spin",
         .unit = "rad/s",
         .part = simulation,
         .meaning = "at the start, about the centre of mass; added to velocity"},
        &p.spin);
  v.key({.name = "velocities",
         .part = simulation,
         .meaning = "a velocity at the start for each vertex, added to these (.npy, float64, (n, 3), m/s)",
         .file = true},
        &p.velocities);
  v.key({.name = "start",
         .part = simulation,
         .meaning =
             "shape of frame 0: at rest, every vertex somewhere in the rest bounding box, or all on a plane "
             "across y; pinned vertices are at rest",
         .choices = sim::start_names},
        &p.start);
  v.key({.name = "seed", .part = simulation, .meaning = "of the start scramble"}, &p.seed);
  v.one({.name = "material", .meaning = "what the body is made of", .is_inline = true}, p.material,
        visit_material);
  v.one({.name = "damping", .meaning = "what takes energy out of its motion", .is_inline = true}, p.damping,
        visit_damping);
  v.one({.name = "surface", .meaning = "what of the body is drawn"}, b.surface, visit_surface);
  v.one({.name = "look", .meaning = "how the body is drawn"}, b, visit_body_look);
  v.one({.name = "wireframe", .meaning = "lines along its edges, over the picture"}, b.wireframe,
        visit_wireframe);
  v.one({.name = "ghost", .meaning = "its rest shape, over the picture"}, b.ghost, visit_ghost);
  v.one({.name = "labels", .meaning = "numbers of its vertices and faces, where they are seen"}, b.labels,
        visit_labels);
  v.list(
      {.name = "pin",
       .meaning = "vertices held where they are at the start, or driven; several selectors select the union"},
      p.pin, visit_pin);
  v.list({.name = "spring", .meaning = "springs to points; several selectors select the union"}, p.spring,
         visit_spring);
  v.list({.name = "load",
          .meaning = "forces that depend on time alone; on the whole body where nothing is selected"},
         p.load, visit_load);
  v.list({.name = "region",
          .meaning =
              "tets of another material or density; several selectors select the union, later regions win"},
         p.region, visit_region);
  v.list(
      {.name = "field", .meaning = "a constant that varies from tet to tet, over regions; later fields win"},
      p.field, visit_field);
}

}  // namespace lagomorph::apps
