#include "apps/error.h"

#include <initializer_list>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/nearest.h"
#include "apps/scene/scene.h"
#include "render/renderer.h"
#include "sim/integrator.h"
#include "sim/materials/table.h"

namespace lagomorph::apps {
namespace error_test {

std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_scene(text, "a.toml", overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::wrong_input);
    return error.what();
  }
  return "no error";
}

const std::string body = "[[body]]\nmesh = \"a.msh\"\n";

/// The text without the body, and the one line that tells what is wrong with it.
struct Wrong {
  std::string text;
  std::string message;
};

/// The body stands last, so that lines count from the text's first.
void expect_told(std::initializer_list<Wrong> cases) {
  for (const Wrong& c : cases) EXPECT_EQ(error_of(c.text + "\n" + body), c.message) << c.text;
}

TEST(WrongScene, Keys) {
  expect_told(
      {Wrong{"[time]\nfsp = 30", "a.toml:2:1: unknown key 'fsp'; did you mean 'fps'?"},
       Wrong{"[time]\n  substep = 2", "a.toml:2:3: unknown key 'substep'; did you mean 'substeps'?"},
       Wrong{"[camra]\nfov = 30", "a.toml:1:2: unknown key 'camra'; did you mean 'camera'?"},
       Wrong{"fov = 30", "a.toml:1:1: unknown key 'fov'; it belongs in [camera], [[camera.key]], [[panel]]"},
       Wrong{"[render]\nradius = 3",
             "a.toml:2:1: unknown key 'radius'; it belongs in [body.pin.sphere], [body.spring.sphere], "
             "[body.load.sphere], [body.region.sphere], [[body.field]], [ground]"},
       Wrong{"[sky]\nqqqqqq = 3",
             "a.toml:2:1: unknown key 'qqqqqq'; known in [sky] are model, zenith, horizon, strength, image, "
             "rotation, elevation, "
             "azimuth, turbidity"},
       Wrong{"[sky]\nzzz = 3\naaa = 4",
             "a.toml:2:1: unknown key 'zzz'; known in [sky] are model, zenith, horizon, strength, image, "
             "rotation, elevation, "
             "azimuth, turbidity"},
       Wrong{"qqqqqq = 3",
             "a.toml:1:1: unknown key 'qqqqqq'; known at the top are name, time, solver, body, camera, "
             "panel, layout, render, ground, light, sky, caption, clip, glyphs, energy_plot, background"}});
}

TEST(WrongScene, Overlays) {
  expect_told(
      {Wrong{"[clip]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]", "a.toml:3:10: clip.normal must not be 0"},
       Wrong{"[clip]\npoint = [0, 0, 0]",
             "a.toml:1:1: clip.normal is missing: towards the tets that are kept, by their centroids at "
             "rest; of any length but 0"},
       Wrong{"clip = 3", "a.toml:1:8: clip must be a table, not 3"}});
  EXPECT_EQ(error_of(body + "wireframe = { show = true, hidden = 'dotted' }"),
            "a.toml:3:37: unknown body.0.wireframe.hidden 'dotted'; known are none, faint, dashed, all");
  EXPECT_EQ(error_of(body + "wireframe = { width = 0 }"),
            "a.toml:3:23: body.0.wireframe.width = 0 is out of range; it must be in (0, 100]");
}

TEST(WrongScene, Syntax) {
  expect_told(
      {Wrong{"[time]\nfps = ", "a.toml:2:7: Error while parsing key-value pair: expected value, saw '\\n'"},
       Wrong{"[time\nfps = 3", "a.toml:1:6: Error while parsing table header: expected ']', saw '\\n'"},
       Wrong{"name = \"a\nb\"",
             "a.toml:1:10: Error while parsing string: unescaped control characters other than TAB (U+0009) "
             "are explicitly prohibited"},
       Wrong{"name = 'a'\nname = 'b'",
             "a.toml:2:8: Error while parsing key-value pair: cannot redefine existing string 'name'"}});
}

TEST(WrongScene, Types) {
  expect_told(
      {Wrong{"[time]\nfps = \"fast\"", "a.toml:2:7: time.fps must be a number, not the string \"fast\""},
       Wrong{"[time]\nfps = true", "a.toml:2:7: time.fps must be a number, not true"},
       Wrong{"[time]\nfps = nan", "a.toml:2:7: time.fps must be a finite number, not nan"},
       Wrong{"[time]\nfps = inf", "a.toml:2:7: time.fps must be a finite number, not inf"},
       Wrong{"[time]\nframes = 2.0", "a.toml:2:10: time.frames must be an integer, not 2.0"},
       Wrong{"[time]\nframes = 2.5", "a.toml:2:10: time.frames must be an integer, not 2.5"},
       Wrong{"[time]\nframes = 2020-01-01",
             "a.toml:2:10: time.frames must be an integer, not a date or time"},
       Wrong{"[time]\nintegrator = 3", "a.toml:2:14: time.integrator must be a string, not 3"},
       Wrong{"[time]\ngravity = -9.81", "a.toml:2:11: time.gravity must be an array of 3 numbers, not -9.81"},
       Wrong{"[time]\ngravity = [0, -9.81]",
             "a.toml:2:11: time.gravity must be an array of 3 numbers, not of 2"},
       Wrong{"[time]\ngravity = [0, 'a', 0]",
             "a.toml:2:15: time.gravity.1 must be a number, not the string \"a\""},
       Wrong{"[ground]\nenabled = 1", "a.toml:2:11: ground.enabled must be true or false, not 1"},
       Wrong{"[render]\nchannels = 'depth'",
             "a.toml:2:12: render.channels must be an array of strings, not the string \"depth\""},
       Wrong{"time = 3", "a.toml:1:8: time must be a table, not 3"},
       Wrong{"[[time]]\nfps = 30",
             "a.toml:1:1: time must be a table, not an array of tables; write [time], not [[time]]"},
       Wrong{"[light]\nradiance = 3",
             "a.toml:1:1: light must be an array of tables, not a table: write [[light]], not [light]"},
       Wrong{"light = [1]", "a.toml:1:10: light.0 must be a table, not 1"}});
}

TEST(WrongScene, Ranges) {
  expect_told(
      {Wrong{"[time]\nfps = -3", "a.toml:2:7: time.fps = -3 is out of range; it must be > 0"},
       Wrong{"[time]\nfps = 0", "a.toml:2:7: time.fps = 0 is out of range; it must be > 0"},
       Wrong{"[time]\nframes = 0",
             "a.toml:2:10: time.frames = 0 is out of range; it must be in 1 .. 10000000"},
       Wrong{"[time]\nsubsteps = 3000000000",
             "a.toml:2:12: time.substeps = 3000000000 is out of range; it must be in 1 .. 2147483647"},
       Wrong{"[solver]\ntolerance = 1",
             "a.toml:2:13: solver.tolerance = 1 is out of range; it must be in (0, 1)"},
       Wrong{"[camera]\nfov = 180.0",
             "a.toml:2:7: camera.fov = 180.0 is out of range; it must be in (0, 180)"},
       Wrong{"[render]\nwidth = 20000",
             "a.toml:2:9: render.width = 20000 is out of range; it must be in 1 .. 16384"},
       Wrong{"[render.raster]\nmultisample = 8",
             "a.toml:2:15: render.raster.multisample = 8 is out of range; it must be 1 or 4"},
       Wrong{"[render.raster]\nsupersample = 8",
             "a.toml:2:15: render.raster.supersample = 8 is out of range; it must be in 1 .. 4"},
       Wrong{"[render.raster]\nshadow_map = 1000",
             "a.toml:2:14: render.raster.shadow_map = 1000 is out of range; it must be in 256 .. 8192, a "
             "power of two"},
       Wrong{"[render.path]\nseed = -1",
             "a.toml:2:8: render.path.seed = -1 is out of range; it must be in 0 .. 4294967295"},
       Wrong{"[ground.material]\nbase_color = [0.5, 1.5, 0.5]",
             "a.toml:2:20: ground.material.base_color.1 = 1.5 is out of range; it must be in 0 .. 1"},
       Wrong{"[render]\nexposure = 1e39",
             "a.toml:2:12: render.exposure = 1e+39 is out of the range of single precision"},
       Wrong{"[ground]\nradius = 1e-60",
             "a.toml:2:10: ground.radius = 1e-60 is out of the range of single precision"}});
}

TEST(WrongScene, Choices) {
  expect_told(
      {Wrong{"[time]\nintegrator = 'backwards_euler'",
             "a.toml:2:14: unknown time.integrator 'backwards_euler'; did you mean 'backward_euler'? Known "
             "are " +
                 joined(sim::integrator_names())},
       Wrong{"[render]\nbackend = 'vulkan'",
             "a.toml:2:11: unknown render.backend 'vulkan'; known are raster, path"},
       Wrong{"[render]\nchannels = ['depth', 'dept']",
             "a.toml:2:22: unknown render.channels.1 'dept'; did you mean 'depth'? Known are " +
                 joined(render::channel_names())}});
}

TEST(WrongScene, Together) {
  expect_told(
      {Wrong{"name = ''", "a.toml:1:8: name = '' must be a plain file name: it is empty"},
       Wrong{"name = '..'", "a.toml:1:8: name = '..' must be a plain file name: it is a folder"},
       Wrong{"name = 'a/b'", "a.toml:1:8: name = 'a/b' must be a plain file name: it has a slash or quote"},
       Wrong{"name = \"a\\nb\"",
             "a.toml:1:8: name = 'a\nb' must be a plain file name: it has control characters"},
       Wrong{"[camera]\nposition = [0, 1, 0]\nlook_at = [0, 1, 0]",
             "a.toml:3:11: camera.position and camera.look_at are the same point"},
       Wrong{"[camera]\nposition = [0, 3, 0]\nlook_at = [0, 1, 0]",
             "a.toml:3:11: camera.up must not be along the view"},
       Wrong{"[camera]\nup = [0, 0, 0]", "a.toml:2:6: camera.up must not be 0"},
       Wrong{"[render]\nchannels = ['normal', 'position']\nchannel_format = 'png'",
             "a.toml:2:12: render.channels: 'position' has values that a PNG does not hold; give "
             "render.channel_format = \"npy\" or \"exr\""},
       Wrong{"[energy_plot]\nrange = [2, 2]",
             "a.toml:2:9: energy_plot.range = [2, 2]: the first must be less than the second"},
       Wrong{"[energy_plot]\ncurves = []",
             "a.toml:2:10: energy_plot.curves is empty; give some of kinetic, elastic, gravitational, total"},
       Wrong{
           "[energy_plot]\ncurves = ['kinetik']",
           "a.toml:2:11: unknown energy_plot.curves.0 'kinetik'; did you mean 'kinetic'? Known are kinetic, "
           "elastic, gravitational, total"},
       Wrong{"[ground]\nradius = 2",
             "a.toml:2:10: ground.fade_start = 3 must be less than ground.radius = 2"},
       Wrong{"[[light]]\nposition = [1, 1, 1]\nlook_at = [1, 1, 1]",
             "a.toml:3:11: light.0.position and light.0.look_at are the same point"},
       Wrong{"[render]\nchannels = ['depth', 'depth']", "a.toml:2:12: render.channels has 'depth' twice"}});
}

/// What is wrong with the table of a body, whose mesh is on line 2 and whose keys begin on line 3.
void expect_told_of_body(std::initializer_list<Wrong> cases) {
  for (const Wrong& c : cases) EXPECT_EQ(error_of(body + c.text), c.message) << c.text;
}

TEST(WrongBody, Keys) {
  expect_told_of_body(
      {Wrong{"density = -1", "a.toml:3:11: body.0.density = -1 is out of range; it must be > 0"},
       Wrong{"yuong = 1",
             "a.toml:3:1: unknown key 'yuong'; did you mean 'young' of [body.material], "
             "[body.region.material]?"},
       Wrong{"young = 1",
             "a.toml:3:1: unknown key 'young'; it belongs in [body.material], [body.region.material]"},
       Wrong{"look.shininess = 1", "a.toml:3:6: unknown key 'shininess'; here it is 'roughness'"},
       Wrong{"material.E = 1e6", "a.toml:3:10: unknown key 'E'; here it is 'young'"},
       Wrong{"mass = 'lump'",
             "a.toml:3:8: unknown body.0.mass 'lump'; did you mean 'lumped'? Known are consistent, lumped"},
       Wrong{"name = ''", "a.toml:3:8: body.0.name = '' must be a plain file name: it is empty"},
       Wrong{"[[body]]\nname = 'b'",
             "a.toml:3:1: body.1.mesh is missing: tet mesh (.mesh, .msh, .node or .ele, "
             ".vtk, .vtu), relative to the scene file"},
       Wrong{"[[body]]\nmesh = 3", "a.toml:4:8: body.1.mesh must be a string, not 3"},
       Wrong{"[[body]]\nmesh = ''", "a.toml:4:8: body.1.mesh is empty"},
       Wrong{"[[body]]\nmesh = 'b.msh'\nname = 'body0'",
             "a.toml:5:8: body.1.name = 'body0' is another body's name"},
       Wrong{"[body.look]\ncolor = [1, 1, 1]",
             "a.toml:4:1: unknown key 'color'; did you mean 'base_color'?"}});
}

TEST(WrongBody, Material) {
  expect_told_of_body(
      {Wrong{"material = { yuong = 1 }", "a.toml:3:14: unknown key 'yuong'; did you mean 'young'?"},
       Wrong{
           "material = { model = 'neo_hokean' }",
           "a.toml:3:22: unknown body.0.material.model 'neo_hokean'; did you mean 'neo_hookean'? Known are " +
               joined(sim::material_names())},
       Wrong{"material = { young = 0 }",
             "a.toml:3:22: body.0.material.young = 0 is out of range; it must be > 0"},
       Wrong{"material = { poisson = 0.5 }",
             "a.toml:3:24: body.0.material.poisson = 0.5 is out of range; it must be in (-1, 0.5)"},
       Wrong{"material = { young = 1, mu = 2, lambda = 3 }",
             "a.toml:3:12: body.0.material: mu and lambda are given beside young or poisson; give one pair"},
       Wrong{"material = { mu = 2 }", "a.toml:3:12: body.0.material: mu is given without lambda; give both"},
       Wrong{"material = { mu = 3, lambda = -2 }",
             "a.toml:3:12: body.0.material: lambda = -2 must be > -2/3 mu"},
       Wrong{"[body.material]\nC = 1\nD = 2",
             "a.toml:3:1: body.0.material: C and D belong to neo_hookean; give young "
             "and poisson, or mu and lambda"},
       Wrong{"material = { model = 'neo_hookean', D = 2 }",
             "a.toml:3:12: body.0.material: D is given without C; give both"},
       Wrong{"material = { model = 'neo_hookean', C = 3, D = -2.5 }",
             "a.toml:3:48: body.0.material.D = -2.5 is out of range; it must be >= 0"},
       Wrong{"material = { model = 'neo_hookean', poisson = -0.5 }",
             "a.toml:3:12: body.0.material: poisson = -0.5 must be in [0, 0.5) for neo_hookean"}});
}

TEST(WrongBody, Pins) {
  expect_told_of_body(
      {Wrong{"[[body.pin]]",
             "a.toml:3:1: body.0.pin.0 selects nothing; give vertices, box, sphere, plane, top or bottom"},
       Wrong{"[body.pin]\ntop = 0.1",
             "a.toml:3:1: body.0.pin must be an array of tables, not a table: write "
             "[[body.pin]], not [body.pin]"},
       Wrong{"[[body.pin]]\nvertices = [0, -1]",
             "a.toml:4:16: body.0.pin.0.vertices.1 = -1 is out of range; it must be >= 0"},
       Wrong{"[[body.pin]]\nvertices = [0, 1.0]",
             "a.toml:4:16: body.0.pin.0.vertices.1 must be an integer, not 1.0"},
       Wrong{"[[body.pin]]\nbox = [0, 0, 0]",
             "a.toml:4:7: body.0.pin.0.box must be an array of 2 corners, [[x, y, z], [x, y, z]], not of 3"},
       Wrong{"[[body.pin]]\nbox = [[0, 0, 0], [1, 1]]",
             "a.toml:4:19: body.0.pin.0.box.1 must be an array of 3 numbers, not of 2"},
       Wrong{"[[body.pin]]\nbox = [[0, 2, 0], [1, 1, 1]]",
             "a.toml:4:7: body.0.pin.0.box: the first corner must be the lesser one in x, y and z"},
       Wrong{"[[body.pin]]\nsphere = { center = [0, 0, 0] }",
             "a.toml:4:10: body.0.pin.0.sphere.radius is missing: its radius"},
       Wrong{"[[body.pin]]\nsphere = { center = [0, 0, 0], radius = -1 }",
             "a.toml:4:41: body.0.pin.0.sphere.radius = -1 is out of range; it must be >= 0"},
       Wrong{"[[body.pin]]\nplane = { point = [0, 0, 0], normal = [0, 0, 0] }",
             "a.toml:4:39: body.0.pin.0.plane.normal must not be 0"},
       Wrong{"[[body.pin]]\ntop = 1.5",
             "a.toml:4:7: body.0.pin.0.top = 1.5 is out of range; it must be in (0, 1]"}});
}

TEST(WrongBody, MotionOfPins) {
  expect_told_of_body(
      {Wrong{"[[body.pin]]\ntop = 0.1\naxes = ['x', 'w']",
             "a.toml:5:14: unknown body.0.pin.0.axes.1 'w'; known are x, y, z"},
       Wrong{"[[body.pin]]\ntop = 0.1\naxes = []",
             "a.toml:5:8: body.0.pin.0.axes is empty; give some of x, y, z"},
       Wrong{"[[body.pin]]\ntop = 0.1\nrelease = 0",
             "a.toml:5:11: body.0.pin.0.release = 0 is out of range; it must be > 0"},
       Wrong{
           "[[body.pin]]\ntop = 0.1\n[[body.pin.key]]\nrotate = [0, 1, 0]",
           "a.toml:5:1: body.0.pin.0.key.0.time is missing: when the vertices are there; later than that of "
           "the key before"},
       Wrong{"[[body.pin]]\ntop = 0.1\n[[body.pin.key]]\ntime = 1\n[[body.pin.key]]\ntime = 0.5",
             "a.toml:8:8: body.0.pin.0.key.1.time = 0.5 must be later than the 1 before it"},
       Wrong{"[[body.pin]]\ntop = 0.1\npath = 'a.npy'\n[[body.pin.key]]\ntime = 1",
             "a.toml:5:8: body.0.pin.0 has both keys and a path; give one of them"}});
}

TEST(WrongBody, SpringsAndLoads) {
  expect_told_of_body(
      {Wrong{"[[body.spring]]\nstiffness = 1",
             "a.toml:3:1: body.0.spring.0 selects nothing; give vertices, box, sphere, plane, top or bottom"},
       Wrong{"[[body.spring]]\ntop = 0.1",
             "a.toml:3:1: body.0.spring.0.stiffness is missing: of each selected vertex's own spring"},
       Wrong{"[[body.load]]\nforce = [1, 0, 0]\ncurve = [[0, 1], [0, 2]]",
             "a.toml:5:9: body.0.load.0.curve: time 0 must be later than the 0 before it"},
       Wrong{"[[body.load]]\ncurve = [0, 1]",
             "a.toml:4:10: body.0.load.0.curve.0 must be an array of 2 numbers, not 0"},
       Wrong{"[[body.load]]\ncurve = 3",
             "a.toml:4:9: body.0.load.0.curve must be an array of pairs of numbers, not 3"}});
}

TEST(WrongScene, WithoutABodyIsTold) {
  EXPECT_EQ(error_of(""), "a.toml: the scene has no body; give at least one [[body]] with a mesh");
  EXPECT_EQ(error_of("body = []"),
            "a.toml:1:8: the scene has no body; give at least one [[body]] with a mesh");
  EXPECT_EQ(error_of("[body]\nmesh = 'a.msh'"),
            "a.toml:1:1: body must be an array of tables, not a table: write [[body]], not [body]");
}

TEST(WrongScene, OverrideIsToldByItself) {
  EXPECT_EQ(error_of(body, {"time.fps=24", "body.0.yuong=1"}),
            "--set body.0.yuong=1: unknown key 'yuong'; did you mean 'young' of [body.material], "
            "[body.region.material]?");
  EXPECT_EQ(error_of(body, {"time.fps=fast"}),
            "--set time.fps=fast: time.fps must be a number, not the string \"fast\"");
  EXPECT_EQ(error_of(body, {"time.fps=0"}), "--set time.fps=0: time.fps = 0 is out of range; it must be > 0");
  EXPECT_EQ(
      error_of(body, {"body.2.density=1"}),
      "--set body.2.density=1: index 2 is out of range; 'body' has 1 element here, and 1 would add one");
  EXPECT_EQ(
      error_of(body, {"body.density=1"}),
      "--set body.density=1: 'body' is an array; what follows must be an index, as in body.0, not 'density'");
  EXPECT_EQ(error_of("[time]\nfps = 30\n" + body, {"time.fps.x=1"}),
            "--set time.fps.x=1: 'time.fps' is a value, it has no 'x'");
  EXPECT_EQ(error_of(body, {"time.fps"}), "--set time.fps: must be key.path=VALUE");
  EXPECT_EQ(error_of(body, {"=3"}), "--set =3: must be key.path=VALUE");
  EXPECT_EQ(error_of(body, {"time..fps=3"}), "--set time..fps=3: the key 'time..fps' has an empty part");
  EXPECT_EQ(error_of(body, {"name=a\xFF"}),
            "--set name=a\xFF: the value is neither TOML nor a line of UTF-8 text");
  EXPECT_EQ(error_of(body, {"camera.fov=30\nrender.width=0"}).substr(0, 14), "--set camera.f");
}

TEST(WrongScene, ThatCannotBeReadIsTold) {
  for (const char* file : {"/no/such/scene.toml", "/"}) {
    try {
      load_scene(file, {});
      ADD_FAILURE() << file;
    } catch (const Error& error) {
      EXPECT_EQ(error.status, ExitStatus::wrong_input);
      EXPECT_EQ(std::string(error.what()).find(file), 0U) << error.what();
    }
  }
}

}  // namespace error_test
}  // namespace lagomorph::apps
