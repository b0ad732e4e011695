#include "apps/scene/body_keys.h"

namespace lagomorph::apps {
namespace {

constexpr Part simulation = Part::simulation;
constexpr const char* pascal = "Pa";

std::vector<std::string> axis_choices() { return {"x", "y", "z"}; }
std::vector<std::string> interpolation_choices() { return {"smooth", "linear"}; }

void visit_selector(sim::Selector& p, KeyVisitor& v) {
  v.key({.name = "vertices",
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "vertex numbers of the body, from 0, in file order"},
        &p.vertices);
  v.key(
      {.name = "box",
       .unit = "m",
       .part = simulation,
       .meaning = "[[x, y, z], [x, y, z]]: rest positions from the least to the greatest corner, inclusive"},
      &p.box);
  v.key({.name = "top",
         .bounds = above_up_to(0, 1),
         .part = simulation,
         .meaning = "upper fraction of the rest bounding box along +y"},
        &p.top);
  v.key({.name = "bottom",
         .bounds = above_up_to(0, 1),
         .part = simulation,
         .meaning = "lower fraction of the rest bounding box along +y"},
        &p.bottom);
  visit_sphere_and_plane(p.sphere, p.plane, v);
}

void visit_pin_key(sim::PinKey& k, KeyVisitor& v) {
  v.key({.name = "time",
         .unit = "s",
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "when the vertices are there; later than that of the key before",
         .required = true},
        &k.time);
  v.key({.name = "translate", .unit = "m", .part = simulation, .meaning = "from the rest position"},
        &k.translate);
  v.key({.name = "rotate",
         .unit = "degrees",
         .part = simulation,
         .meaning = "about the fixed x, then y, then z axis through the center; more than 360 turn on"},
        &k.rotate);
  v.key({.name = "scale", .bounds = above(0), .part = simulation, .meaning = "about the center"}, &k.scale);
}

}  // namespace

void visit_sphere_and_plane(std::optional<sim::SphereSelector>& sphere,
                            std::optional<sim::PlaneSelector>& plane, KeyVisitor& v) {
  v.optional(
      {.name = "sphere", .meaning = "rest positions inside a sphere", .is_inline = true}, sphere,
      [](sim::SphereSelector& s, KeyVisitor& inside_sphere) {
        inside_sphere.key(
            {.name = "center", .unit = "m", .part = simulation, .meaning = "its centre", .required = true},
            &s.center);
        inside_sphere.key({.name = "radius",
                           .unit = "m",
                           .bounds = at_least(0),
                           .part = simulation,
                           .meaning = "its radius",
                           .required = true},
                          &s.radius);
      });
  v.optional(
      {.name = "plane", .meaning = "rest positions X with (X - point) . normal >= 0", .is_inline = true},
      plane, [](sim::PlaneSelector& s, KeyVisitor& inside_plane) {
        inside_plane.key({.name = "point",
                          .unit = "m",
                          .part = simulation,
                          .meaning = "a point of the plane",
                          .required = true},
                         &s.point);
        inside_plane.key({.name = "normal",
                          .part = simulation,
                          .meaning = "towards the selected side, of any length but 0",
                          .required = true},
                         &s.normal);
      });
}

void visit_pin(sim::PinSettings& p, KeyVisitor& v) {
  visit_selector(p, v);
  v.key({.name = "axes",
         .part = simulation,
         .meaning = "that are held; along the others the vertices are free",
         .choices = axis_choices},
        &p.axes);
  v.key({.name = "interpolation",
         .part = simulation,
         .meaning = "between keys or samples; smooth: once differentiable, monotone between them, at rest "
                    "where they turn and at the first and last key",
         .choices = interpolation_choices},
        &p.interpolation);
  v.key({.name = "center",
         .unit = "m",
         .part = simulation,
         .meaning = "that keys turn and scale about",
         .default_note = "mean of the vertices at rest"},
        &p.center);
  v.key(
      {.name = "path",
       .part = simulation,
       .meaning = "recorded path (.npy, float64), instead of keys: displacements (T, 3) of all, or positions "
                  "(T, n, 3) of the n vertices in ascending order",
       .file = true},
      &p.path);
  v.key({.name = "path_fps",
         .unit = "1/s",
         .bounds = above(0),
         .part = simulation,
         .meaning = "samples of the path a second; the first is at t = 0",
         .default_note = "time.fps"},
        &p.path_fps);
  v.key({.name = "release",
         .unit = "s",
         .bounds = above(0),
         .part = simulation,
         .meaning =
             "from then on the vertices are free, with the velocity that they have; to the nearest step"},
        &p.release);
  v.list({.name = "key",
          .meaning =
              "where the vertices are at a time: center + translate + rotate(scale (X - center)); at rest "
              "at 0 where the first is later"},
         p.key, visit_pin_key);
}

void visit_spring(sim::SpringSettings& s, KeyVisitor& v) {
  visit_selector(s, v);
  v.key({.name = "stiffness",
         .unit = "N/m",
         .bounds = above(0),
         .part = simulation,
         .meaning = "of each selected vertex's own spring",
         .required = true},
        &s.stiffness);
  v.key({.name = "to",
         .unit = "m",
         .part = simulation,
         .meaning = "point that they pull to",
         .default_note = "each vertex's rest position"},
        &s.to);
  v.key({.name = "rest_length",
         .unit = "m",
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "at which they do not pull"},
        &s.rest_length);
}

void visit_load(sim::LoadSettings& l, KeyVisitor& v) {
  visit_selector(l, v);
  v.key({.name = "force",
         .unit = "N",
         .part = simulation,
         .meaning = "in all, in equal parts to the selected vertices"},
        &l.force);
  v.key({.name = "traction",
         .unit = "N/m^2",
         .part = simulation,
         .meaning = "per rest area of boundary triangles with all corners selected"},
        &l.traction);
  v.key(
      {.name = "pressure",
       .unit = pascal,
       .part = simulation,
       .meaning = "likewise, against their outward normal at rest; a dead load, it does not turn with them"},
      &l.pressure);
  v.key({.name = "body_force",
         .unit = "N/m^3",
         .part = simulation,
         .meaning = "per rest volume of tets with all corners selected"},
        &l.body_force);
  v.key(
      {.name = "acceleration", .unit = "m/s^2", .part = simulation, .meaning = "likewise, times their mass"},
      &l.acceleration);
  v.key({.name = "curve",
         .unit = "s, 1",
         .part = simulation,
         .meaning = "[[time, factor], ...] of all of these: linear between, constant outside; without it 1"},
        &l.curve);
}

}  // namespace lagomorph::apps
