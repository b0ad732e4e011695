#include "apps/scene/surroundings_keys.h"

#include "apps/scene/body_keys.h"
#include "render/ground_texture.h"

namespace lagomorph::apps {
namespace {

std::vector<std::string> light_kinds() { return {"area", "sun"}; }
std::vector<std::string> sky_models() { return {"gradient", "physical"}; }

}  // namespace

void visit_ground(render::Ground& g, KeyVisitor& v) {
  v.key({.name = "enabled", .meaning = "whether there is a floor"}, &g.enabled);
  v.key({.name = "height", .unit = "m", .meaning = "y of the floor"}, &g.height);
  v.key({.name = "center", .unit = "m", .meaning = "of its disc; y has no effect"}, &g.center);
  v.key({.name = "radius",
         .unit = "m",
         .bounds = above(0),
         .meaning = "where it has faded into the background"},
        &g.radius);
  v.key({.name = "fade_start",
         .unit = "m",
         .bounds = at_least(0),
         .meaning = "up to where it is opaque, < radius"},
        &g.fade_start);
  v.key({.name = "shadow_catcher",
         .meaning =
             "with render.transparent the floor is not seen, but the bodies' shadows on it, as alpha: the "
             "part of its light that they take"},
        &g.shadow_catcher);
  v.key({.name = "texture",
         .meaning = "squares of two colours, or lines, from the world's origin; lines at whole metres are "
                    "three times as wide",
         .choices = render::ground_texture_names},
        &g.texture);
  v.key({.name = "texture_size", .unit = "m", .bounds = between(0.001, 1e6), .meaning = "side of a square"},
        &g.texture_size);
  v.key({.name = "texture_color",
         .bounds = between(0, 1),
         .meaning = "linear RGB of every other square, or of the lines"},
        &g.texture_color);
  v.key({.name = "line_width", .unit = "m", .bounds = between(1e-6, 1e6), .meaning = "of the grid's lines"},
        &g.line_width);
  v.one({.name = "material", .meaning = "how it is drawn", .is_inline = true}, g.material, visit_look);
}

void visit_light(LightDesc& l, KeyVisitor& v) {
  v.key(
      {.name = "kind",
       .meaning = "a rectangle with position, look_at, size and radiance, or a sun with direction, angle and "
                  "irradiance",
       .choices = light_kinds},
      &l.kind);
  v.key({.name = "position", .unit = "m", .meaning = "middle of the rectangle"}, &l.position);
  v.key({.name = "look_at", .unit = "m", .meaning = "where it shines; the other side is dark"}, &l.look_at);
  v.key({.name = "size", .unit = "m", .bounds = above(0), .meaning = "width, height"}, &l.size);
  v.key({.name = "color", .bounds = at_least(0), .meaning = "linear RGB"}, &l.color);
  v.key({.name = "radiance", .unit = "W/(sr m^2)", .bounds = at_least(0), .meaning = "of white; times color"},
        &l.radiance);
  v.key({.name = "direction", .meaning = "of a sun: the way it shines, of any length but 0"}, &l.direction);
  v.key({.name = "angle",
         .unit = "degrees",
         .bounds = between(0.01, 90),
         .meaning = "of a sun: its diameter; the larger, the softer its shadows"},
        &l.angle);
  v.key({.name = "irradiance",
         .unit = "W/m^2",
         .bounds = at_least(0),
         .meaning = "of a white sun, on a surface that faces it; times color"},
        &l.irradiance);
  v.key({.name = "visible", .meaning = "whether the camera sees it"}, &l.visible);
}

void visit_sky(SkyDesc& s, KeyVisitor& v) {
  v.key({.name = "model",
         .meaning = "gradient: zenith and horizon; physical: a clear sky and its sun",
         .choices = sky_models},
        &s.model);
  v.key({.name = "zenith", .bounds = at_least(0), .meaning = "linear RGB straight up"}, &s.zenith);
  v.key({.name = "horizon", .bounds = at_least(0), .meaning = "linear RGB at the horizon and below"},
        &s.horizon);
  v.key({.name = "strength",
         .unit = "W/(sr m^2)",
         .bounds = at_least(0),
         .meaning =
             "radiance of white; with an image, of its value 1; with the physical model the sun's irradiance "
             "above the air [W/m^2]",
         .default_note = "0.6; 1 with an image; 5 with the physical model"},
        &s.strength);
  v.key({.name = "image",
         .meaning = "Radiance picture (.hdr) in latitude and longitude that lights the scene, instead of the "
                    "model; its "
                    "top is +y, its middle -z, +x to the right of that",
         .file = true},
        &s.image);
  v.key({.name = "rotation",
         .unit = "degrees",
         .meaning = "azimuth that the image's middle faces: 0 is -z, 90 is +x"},
        &s.rotation);
  v.key({.name = "elevation",
         .unit = "degrees",
         .bounds = between(-5, 90),
         .meaning = "of the physical model's sun above the horizon"},
        &s.atmosphere.elevation);
  v.key({.name = "azimuth", .unit = "degrees", .meaning = "of the physical model's sun: 0 is -z, 90 is +x"},
        &s.atmosphere.azimuth);
  v.key({.name = "turbidity",
         .bounds = between(1, 10),
         .meaning = "of the physical model's air: 1 without haze, 3 clear, 10 hazy"},
        &s.atmosphere.turbidity);
}

void visit_background(std::optional<render::Color>& color, KeyVisitor& v) {
  v.key({.name = "color",
         .bounds = at_least(0),
         .meaning =
             "linear RGB of what the camera sees where nothing is; without it the sky. Under transparent "
             "pictures only in their video; without it white"},
        &color);
}

}  // namespace lagomorph::apps
