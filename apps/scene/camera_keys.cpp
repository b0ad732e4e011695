#include "apps/scene/camera_keys.h"

#include "apps/scene/body_keys.h"
#include "apps/scene/camera_moves.h"

namespace lagomorph::apps {
namespace {

std::vector<std::string> interpolation_choices() { return {"smooth", "linear"}; }
std::vector<std::string> follow_choices() { return {"none", "center_of_mass"}; }

/// A panel may leave it to the camera.
std::vector<std::string> or_same(std::vector<std::string> names) {
  names.insert(names.begin(), "same");
  return names;
}
std::vector<std::string> panel_views() { return or_same(camera_views()); }
std::vector<std::string> panel_frames() { return or_same(camera_frames()); }
std::vector<std::string> panel_fields() { return or_same(field_choices()); }
std::vector<std::string> panel_colormaps() { return or_same(colormap_choices()); }

void visit_lens(render::CameraSettings& c, KeyVisitor& v) {
  v.key({.name = "f_stop",
         .bounds = at_least(0),
         .meaning =
             "focal length over the lens' diameter, for depth of field (path, perspective); 0: all is sharp. "
             "The focal length is sensor_height / (2 tan(fov/2)), 51 mm at 26.5 degrees, so that things of a "
             "metre blur much below f/1 only, or with a larger sensor"},
        &c.f_stop);
  v.key({.name = "focus_distance",
         .unit = "m",
         .bounds = above(0),
         .meaning = "along the view axis, of the plane that is sharp",
         .default_note = "look_at's"},
        &c.focus_distance);
  v.key({.name = "sensor_height",
         .unit = "m",
         .bounds = above(0),
         .meaning = "of the picture in the camera; 24 mm is 35 mm film"},
        &c.sensor_height);
  v.key({.name = "blades",
         .bounds = between(0, 64),
         .meaning = "of the aperture, which is a polygon of so many corners; 0: a disc",
         .holds = [](double n) { return n == 0 || n >= 3; },
         .rule = "not 1 or 2"},
        &c.blades);
  v.key({.name = "blade_rotation", .unit = "degrees", .meaning = "counterclockwise"}, &c.blade_rotation);
  v.key(
      {.name = "shutter",
       .bounds = between(0, 1),
       .meaning =
           "part of the time between frames that the shutter is open, until the frame (path): motion blur of "
           "bodies, on curves by positions and velocities of both states, and of the camera; 0.5 is usual. "
           "Frame 0 has none"},
      &c.shutter);
}

void visit_camera_key(CameraKey& k, KeyVisitor& v) {
  v.key({.name = "time", .unit = "s", .bounds = at_least(0), .meaning = "when; later than the key before"},
        &k.time);
  v.key(
      {.name = "frame", .bounds = at_least(0), .meaning = "the same by the frame's number, instead of time"},
      &k.frame);
  v.key({.name = "position", .unit = "m", .meaning = "of the eye"}, &k.position);
  v.key({.name = "look_at", .unit = "m", .meaning = "what is in the middle of the picture"}, &k.look_at);
  v.key({.name = "up", .meaning = "what is up in the picture"}, &k.up);
  v.key({.name = "fov", .unit = "degrees", .bounds = inside(0, 180), .meaning = "vertical field of view"},
        &k.fov);
  v.key({.name = "orthographic",
         .unit = "m",
         .bounds = above(0),
         .meaning = "height of the view; only where camera.orthographic is given"},
        &k.orthographic);
  v.key({.name = "zoom", .bounds = above(0), .meaning = "in place of camera.zoom"}, &k.zoom);
  v.key({.name = "focus_distance", .unit = "m", .bounds = above(0), .meaning = "of the sharp plane"},
        &k.focus_distance);
  v.key({.name = "f_stop", .bounds = at_least(0), .meaning = "of the lens"}, &k.f_stop);
}

void visit_turntable(TurntableDesc& t, KeyVisitor& v) {
  v.key({.name = "turns",
         .meaning = "over the whole sequence, so that its end meets its beginning; counterclockwise from "
                    "above, below 0 clockwise"},
        &t.turns);
  v.key({.name = "period",
         .unit = "s",
         .meaning = "of one turn, instead of turns; below 0 clockwise",
         .holds = [](double s) { return s != 0.0; },
         .rule = "not 0"},
        &t.period);
  v.key({.name = "start", .unit = "degrees", .meaning = "by how much it is turned in frame 0"}, &t.start);
}

}  // namespace

void visit_camera(CameraDesc& c, KeyVisitor& v) {
  v.key({.name = "position", .unit = "m", .meaning = "of the eye"}, &c.position);
  v.key({.name = "look_at", .unit = "m", .meaning = "what is in the middle of the picture"}, &c.look_at);
  v.key({.name = "up", .meaning = "what is up in the picture; not along the view"}, &c.up);
  v.key({.name = "fov", .unit = "degrees", .bounds = inside(0, 180), .meaning = "vertical field of view"},
        &c.fov);
  v.key({.name = "orthographic",
         .unit = "m",
         .bounds = above(0),
         .meaning =
             "height of the view; given, the projection is orthographic and fov and lens have no effect"},
        &c.orthographic);
  v.key(
      {.name = "view",
       .meaning = "the side that is looked from, about look_at and as far from it as position is: front from "
                  "+z, right from +x, top from +y, isometric from between these three; from the bottom the "
                  "ground is left out; none: from position",
       .choices = camera_views},
      &c.view);
  v.key({.name = "frame",
         .meaning = "center: look at the middle of the bodies' box in frame 0; rest: also from as far, or as "
                    "high an orthographic view, as this box fits into the picture; motion: the box of all "
                    "frames. Position and look_at then only give the direction",
         .choices = camera_frames},
        &c.frame);
  v.key({.name = "margin",
         .bounds = {.low = 0, .high = 0.45},
         .meaning = "what a fitted box leaves free on each side, of the picture's width or height"},
        &c.margin);
  v.key({.name = "zoom", .bounds = above(0), .meaning = "magnifies the middle of all these views"}, &c.zoom);
  v.key(
      {.name = "follow",
       .meaning = "center_of_mass: position and look_at move as the bodies' centre of mass does from frame 0",
       .choices = follow_choices},
      &c.follow);
  visit_lens(c, v);
  v.one({.name = "turntable", .meaning = "the camera goes around look_at, about +y", .is_inline = true},
        c.turntable, visit_turntable);
  v.key(
      {.name = "interpolation",
       .meaning = "between keys; smooth: once differentiable, monotone between them, at rest where they turn "
                  "and at the first and last key",
       .choices = interpolation_choices},
      &c.interpolation);
  v.list({.name = "key",
          .meaning = "the camera at a time; what a key leaves open passes through those that give it"},
         c.key, visit_camera_key);
}

void visit_panel(PanelDesc& p, KeyVisitor& v) {
  v.key({.name = "title", .meaning = "written at its top"}, &p.title);
  v.key({.name = "view", .meaning = "as camera.view", .choices = panel_views}, &p.view);
  v.key({.name = "frame", .meaning = "as camera.frame", .choices = panel_frames}, &p.frame);
  v.key({.name = "position", .unit = "m", .meaning = "as camera.position; without it the camera's"},
        &p.position);
  v.key({.name = "look_at", .unit = "m", .meaning = "likewise"}, &p.look_at);
  v.key({.name = "up", .meaning = "likewise"}, &p.up);
  v.key({.name = "fov", .unit = "degrees", .bounds = inside(0, 180), .meaning = "likewise"}, &p.fov);
  v.key({.name = "orthographic", .unit = "m", .bounds = above(0), .meaning = "likewise"}, &p.orthographic);
  v.key({.name = "zoom", .bounds = above(0), .meaning = "likewise"}, &p.zoom);
  v.key({.name = "field",
         .meaning = "shown on all bodies, as body.N.look.field; same: as the bodies say",
         .choices = panel_fields},
        &p.field);
  v.key({.name = "colormap", .meaning = "of its field", .choices = panel_colormaps}, &p.colormap);
  v.key({.name = "range",
         .unit = "of the field",
         .meaning = "of its field; without it the least and the greatest of all frames"},
        &p.range);
}

void visit_layout(LayoutDesc& l, KeyVisitor& v) {
  v.key({.name = "columns",
         .bounds = between(0, 64),
         .meaning = "of panels; 0: a row of up to three, of more as near to a square as can be"},
        &l.columns);
  v.key({.name = "gap", .unit = "pixels", .bounds = between(0, 256), .meaning = "between panels"}, &l.gap);
}

}  // namespace lagomorph::apps
