#include "apps/scene/keys.h"

#include <fmt/format.h>

#include "apps/scene/body_keys.h"
#include "apps/scene/camera_keys.h"
#include "apps/scene/overlay_keys.h"
#include "apps/scene/render_keys.h"
#include "apps/scene/step_keys.h"
#include "apps/scene/surroundings_keys.h"

namespace lagomorph::apps {

std::string Bounds::text() const {
  const bool has_low = low != -std::numeric_limits<double>::infinity();
  const bool has_high = high != std::numeric_limits<double>::infinity();
  if (has_low && has_high) {
    if (!open_low && !open_high) return fmt::format("in {} .. {}", low, high);
    return fmt::format("in {}{}, {}{}", open_low ? '(' : '[', low, high, open_high ? ')' : ']');
  }
  if (has_low) return fmt::format("{} {}", open_low ? ">" : ">=", low);
  if (has_high) return fmt::format("{} {}", open_high ? "<" : "<=", high);
  return {};
}

std::string valid_numbers(const Key& k) {
  std::string bounds = k.bounds.text();
  if (k.rule == nullptr) return bounds;
  return bounds.empty() ? k.rule : fmt::format("{}, {}", bounds, k.rule);
}

std::vector<std::string> shown_choices(const Key& k) {
  std::vector<std::string> choices = k.choices();
  std::erase(choices, "null");
  return choices;
}

void visit_scene(SceneDesc& s, KeyVisitor& v) {
  v.key({.name = "name",
         .part = Part::none,
         .meaning = "of the scene and of what is written; a plain file name",
         .default_note = "the file's name"},
        &s.name);
  v.one({.name = "time", .meaning = "frames and steps"}, s.time, visit_time);
  v.one({.name = "solver", .meaning = "how a step is solved"}, s.solver, visit_solver);
  v.list({.name = "body", .meaning = "what moves; at least one", .required = true}, s.body, visit_body);
  v.one({.name = "camera", .meaning = "where the pictures are taken from"}, s.camera, visit_camera);
  v.list({.name = "panel",
          .meaning = "several pictures in one, side by side: the scene with another camera or field in each"},
         s.panel, visit_panel);
  v.one({.name = "layout", .meaning = "of panels"}, s.layout, visit_layout);
  v.one({.name = "render", .meaning = "the pictures"}, s.render, visit_render);
  v.one({.name = "ground", .meaning = "a floor that receives shadows and fades into the background"},
        s.ground, visit_ground);
  v.list(
      {.name = "light",
       .meaning = "a rectangle that shines or a sun; one where the scene names none, none with `light = []`"},
      s.light, visit_light);
  v.one({.name = "sky", .meaning = "light from all around"}, s.sky, visit_sky);
  v.one({.name = "caption", .meaning = "text over the pictures"}, s.caption, visit_caption);
  v.optional({.name = "clip",
              .meaning = "a plane that opens the bodies: whole tets on one side of it are drawn, the same in "
                         "all frames, instead of surfaces"},
             s.clip, visit_clip);
  v.one({.name = "glyphs", .meaning = "signs of what holds, pulls and moves the bodies, over the picture"},
        s.glyphs, visit_glyphs);
  v.one({.name = "energy_plot",
         .meaning = "a diagram of the energies up to the frame, over the picture; its axes span all frames"},
        s.energy_plot, visit_energy_plot);
  v.one({.name = "background", .meaning = "what the camera sees where nothing is"}, s.background,
        visit_background);
}

SceneDesc default_scene() {
  SceneDesc scene;
  scene.light.emplace_back();  // the key light of a scene that names none
  return scene;
}

}  // namespace lagomorph::apps
