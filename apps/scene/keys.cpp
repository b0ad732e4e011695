#include "apps/scene/keys.h"

#include <bit>

#include <fmt/format.h>

#include "apps/overlay/caption.h"
#include "apps/run/channel_files.h"
#include "apps/scene/body_keys.h"
#include "apps/scene/camera_keys.h"
#include "apps/scene/overlay_keys.h"
#include "render/color.h"
#include "render/ground_texture.h"
#include "render/path/filter.h"
#include "render/renderer.h"
#include "sim/integrator.h"
#include "sim/start.h"

namespace lagomorph::apps {
namespace {

constexpr Part simulation = Part::simulation;

std::vector<std::string> mass_choices() { return {"consistent", "lumped"}; }
std::vector<std::string> element_choices() { return {"mesh", "linear", "quadratic"}; }
std::vector<std::string> light_kinds() { return {"area", "sun"}; }
std::vector<std::string> sky_models() { return {"gradient", "physical"}; }
std::vector<std::string> hessian_choices() { return {"auto", "projected"}; }
std::vector<std::string> linear_choices() { return {"auto", "cholmod", "cg"}; }

void visit_time(sim::TimeSettings& t, KeyVisitor& v) {
  v.key({.name = "fps",
         .unit = "1/s",
         .bounds = above(0),
         .part = simulation,
         .meaning = "frames a second; frame k is at t = k / fps"},
        &t.fps);
  v.key({.name = "frames",
         .bounds = between(1, 1e7),
         .part = Part::none,
         .meaning = "pictures 0 .. frames - 1; frame 0 is the initial state",
         .default_note = "150; 2 with the integrator static"},
        &t.frames);
  v.key({.name = "substeps", .bounds = at_least(1), .part = simulation, .meaning = "steps a frame"},
        &t.substeps);
  v.key(
      {.name = "integrator",
       .part = simulation,
       .meaning = "time-stepping scheme; static: frame 0 is at rest, each other the equilibrium of its time",
       .choices = sim::integrator_names},
      &t.integrator);
  v.key({.name = "gravity", .unit = "m/s^2", .part = simulation, .meaning = "acceleration of free fall"},
        &t.gravity);
  v.key({.name = "error_tolerance",
         .unit = "m",
         .bounds = above(0),
         .part = simulation,
         .meaning = "a step whose estimated error of positions is larger is halved"},
        &t.error_tolerance);
}

void visit_solver(sim::SolverSettings& s, KeyVisitor& v) {
  v.key({.name = "tolerance",
         .bounds = inside(0, 1),
         .part = simulation,
         .meaning =
             "Newton stops at |g_free| <= tolerance * |(M g)_free|, 2-norms; without gravity the largest "
             "of the inertial and elastic parts instead"},
        &s.tolerance);
  v.key({.name = "max_iterations",
         .bounds = at_least(1),
         .part = simulation,
         .meaning = "Newton iterations a step"},
        &s.max_iterations);
  v.key({.name = "max_halvings",
         .bounds = between(0, 30),
         .part = simulation,
         .meaning = "how often a step that does not converge is halved before the run ends"},
        &s.max_halvings);
  v.key(
      {.name = "hessian",
       .part = simulation,
       .meaning = "auto: exact while its Cholesky factorization succeeds, else projected element by element; "
                  "projected: always",
       .choices = hessian_choices},
      &s.hessian);
  v.key(
      {.name = "linear",
       .part = simulation,
       .meaning =
           "how linear systems are solved. cg: conjugate gradients preconditioned by the diagonal's blocks; "
           "cholmod: a factor a step, which preconditions its further systems; auto: cg while that is less "
           "work, else the like with a factor at rest, turned with the body, while strains are small",
       .choices = linear_choices},
      &s.linear);
  v.key({.name = "blas_threads",
         .bounds = between(1, 64),
         .part = simulation,
         .meaning = "threads of OpenBLAS inside CHOLMOD; part of the result's bits, so of the scene"},
        &s.blas_threads);
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

void visit_body_look(BodyDesc& b, KeyVisitor& v) {
  visit_look(b.look, v);
  visit_optics(b.look, v);
  visit_shown_field(b.shown, v);
}

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

void visit_raster(render::RasterSettings& r, KeyVisitor& v) {
  v.key({.name = "multisample",
         .meaning = "samples a pixel of the rasterizer",
         .holds = [](double n) { return n == 1 || n == 4; },
         .rule = "1 or 4"},
        &r.multisample);
  v.key({.name = "supersample",
         .bounds = between(1, 4),
         .meaning =
             "pictures are drawn so many times as wide and high, then reduced: highlights and textures are "
             "smooth as well as edges"},
        &r.supersample);
  v.key({.name = "shadow_map",
         .unit = "pixels",
         .bounds = between(256, 8192),
         .meaning = "along a side",
         .holds = [](double n) { return std::has_single_bit(static_cast<unsigned>(n)); },
         .rule = "a power of two"},
        &r.shadow_map);
  v.key({.name = "shadow_samples", .bounds = between(1, 64), .meaning = "taps of the soft shadow filter"},
        &r.shadow_samples);
}

void visit_path(render::PathSettings& p, KeyVisitor& v) {
  v.key({.name = "bounces", .bounds = between(0, 64), .meaning = "indirect bounces after the first hit"},
        &p.bounces);
  v.key({.name = "transmission_bounces",
         .bounds = between(0, 256),
         .meaning = "further ones through or off the inside of clear bodies"},
        &p.transmission_bounces);
  v.key({.name = "clamp",
         .unit = "W/(sr m^2)",
         .bounds = at_least(0),
         .meaning = "most that a path brings of indirect light, against fireflies; 0: all of it"},
        &p.clamp);
  v.key({.name = "seed", .meaning = "of the sample sequence"}, &p.seed);
  v.key({.name = "filter", .meaning = "pixel reconstruction", .choices = render::path::filter_names},
        &p.filter);
  v.key({.name = "filter_radius",
         .unit = "pixels",
         .bounds = above_up_to(0, 4),
         .meaning = "of the reconstruction filter"},
        &p.filter_radius);
  v.key({.name = "noise_threshold",
         .bounds = at_least(0),
         .meaning =
             "adaptive sampling: squares of 8x8 pixels get no more samples once their noise (standard error "
             "over "
             "the square root of the luminance) is below this; 0.01 is usual, 0: all get render.samples"},
        &p.noise_threshold);
  v.key({.name = "min_samples", .bounds = between(1, 65536), .meaning = "of adaptive sampling, a pixel"},
        &p.min_samples);
  v.key(
      {.name = "denoise",
       .meaning = "smooths the noise away, guided by normal, albedo, depth and variance; needs 2 samples or "
                  "more. Not for goldens: what is left of the noise is no longer that of each pixel alone"},
      &p.denoise);
}

void visit_render(render::RenderSettings& r, KeyVisitor& v) {
  v.key({.name = "backend", .meaning = "who draws", .choices = render::renderer_names}, &r.backend);
  v.key({.name = "width", .unit = "pixels", .bounds = between(1, 16384), .meaning = "of the picture"},
        &r.width);
  v.key({.name = "height", .unit = "pixels", .bounds = between(1, 16384), .meaning = "of the picture"},
        &r.height);
  v.key({.name = "samples", .bounds = between(1, 65536), .meaning = "paths a pixel (path only)"}, &r.samples);
  v.key({.name = "tone_curve",
         .meaning = "from linear light to the display",
         .choices = render::tone_curve_names},
        &r.tone_curve);
  v.key(
      {.name = "exposure", .unit = "stops", .meaning = "linear light times 2^exposure before the tone curve"},
      &r.exposure);
  v.key({.name = "dither",
         .unit = "8-bit steps",
         .bounds = between(0, 2),
         .meaning =
             "pictures are rounded to 8 bits under a fine fixed pattern of this height, against bands in "
             "smooth gradients; 1 hides them all, 0: none"},
        &r.dither);
  v.key({.name = "png_compression", .bounds = between(0, 12), .meaning = "zlib level of the pictures"},
        &r.png_compression);
  v.key({.name = "channels",
         .meaning = "written beside the picture, to RUN/aov/NAME/",
         .choices = render::channel_names},
        &r.channels);
  v.key({.name = "channel_format",
         .meaning =
             "of their files: NumPy arrays, OpenEXR, one OpenEXR for the picture and all of them, or 16-bit "
             "PNG of those that fit",
         .choices = channel_formats},
        &r.channel_format);
  v.key({.name = "transparent",
         .meaning = "nothing is seen where nothing is: pictures have an alpha channel, of which the ground's "
                    "fading edge takes its part"},
        &r.transparent);
  v.key(
      {.name = "region",
       .unit = "pixels",
       .bounds = at_least(0),
       .meaning = "[x0, y0, x1, y1]: only these pixels, from the top left corner, without column x1 and row "
                  "y1; pictures have their size; empty: all"},
      &r.region);
  v.one({.name = "raster", .meaning = "of the raster back end"}, r.raster, visit_raster);
  v.one({.name = "path", .meaning = "of the path back end"}, r.path, visit_path);
}

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

void visit_caption(CaptionDesc& c, KeyVisitor& v) {
  v.key({.name = "text",
         .meaning = "written over each picture, with values as {name}, {frame:04}, {frames}, {time:.2f}, "
                    "{kinetic:.1f}, "
                    "{elastic}, {gravitational}, {total}, {iterations}, {min_J}; empty: nothing"},
        &c.text);
  v.key({.name = "place", .meaning = "where in the picture", .choices = caption_places}, &c.place);
}

void visit_background(std::optional<render::Color>& color, KeyVisitor& v) {
  v.key({.name = "color",
         .bounds = at_least(0),
         .meaning =
             "linear RGB of what the camera sees where nothing is; without it the sky. Under transparent "
             "pictures only in their video; without it white"},
        &color);
}

}  // namespace

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
