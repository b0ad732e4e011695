#include "apps/cli/command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/check/limits.h"
#include "apps/commands.h"
#include "apps/nearest.h"
#include "apps/version.h"
#include "apps/video/video.h"
#include "render/renderer.h"
#include "sim/integrator.h"
#include "sim/materials/table.h"

namespace lagomorph::apps {
namespace {

constexpr int most_threads = 1024;
constexpr int most_pixels_per_degree = 1000;  // FLIP's

struct CommandRow {
  const char* name;
  const char* input;  // what it takes, as in the usage line: names between spaces
  const char* meaning;
  const char* example;
  ExitStatus (*run)(const Options&);
};
constexpr CommandRow commands[] = {
    {"run", "SCENE.toml", "simulate and render a scene into RUN, by default out/<scene name>",
     "lagomorph run bunny --frames 0..29 --backend path -o out/short", run_command},
    {"simulate", "SCENE.toml", "simulate only: states and energies into RUN",
     "lagomorph simulate scenes/bar.toml --set body.0.density=500", simulate_command},
    {"render", "RUN", "draw pictures from the states of a run",
     "lagomorph render out/bunny --set camera.fov=25 -o out/closer", render_command},
    {"check", "RUN GOLDEN", "hold the pictures of a run against a golden; reports go to RUN/check",
     "lagomorph check out/bunny golden/bunny --set limits.flip_mean=0.02", check_command},
    {"approve", "RUN GOLDEN", "make the pictures of a run golden where they fail; passing frames are left",
     "lagomorph approve out/bunny golden/bunny --frames 12..14", approve_command},
    {"preview", "RUN", "contact sheet, animation, page and summary of a run, or of any numbered PNGs",
     "lagomorph preview out/bunny --frames 0..59 -o out/look", preview_command},
    {"plot", "RUN", "diagrams of a run: energies, momentum, iterations, seconds a stage",
     "lagomorph plot out/bunny --columns kinetic,elastic --format svg", plot_command},
    {"export", "RUN", "a run's states for other tools: tets with their fields, or surfaces",
     "lagomorph export out/bunny --format vtu --fields von_mises,J", export_command},
    {"compare", "A B", "tell whether two pictures are the same, and by how much they differ",
     "lagomorph compare golden.png new.png --heat heat.png", compare_command},
    {"refine", "MESH", "split each tet of a mesh in eight, or raise its order; into -o OUT.msh",
     "lagomorph refine meshes/bar.msh --levels 2 --order 2 -o out/bar_fine.msh", refine_command},
    {"info", "FILE", "tell what a mesh, a scene or a run is", "lagomorph info meshes/bunny.msh --json",
     info_command},
    {"material", "MODEL", "a material's stress and stiffness at one F, or its stress-stretch curves",
     "lagomorph material neo_hookean --young 1e6 --poisson 0.3 --F \"1.2,0,0,0,1,0,0,0,1\" --json",
     material_command},
};

struct OptionRow {
  const char* flags;     // as CLI11 takes them
  const char* value;     // what it takes; nullptr for a flag
  const char* commands;  // that know it, between spaces
  const char* meaning;
  void (*apply)(Options&, const std::string&);
};

std::string non_empty(const std::string& value, const char* option) {
  if (value.empty()) wrong_input(fmt::format("{} is empty", option));
  return value;
}

void apply_set(Options& o, const std::string& value) {
  const std::size_t equals = value.find('=');
  if (equals == std::string::npos || equals == 0) {
    wrong_input(fmt::format("--set {}: must be key.path=VALUE, as in --set time.fps=24", value));
  }
  o.set.push_back(value);
}

void apply_backend(Options& o, const std::string& value) {
  std::vector<std::string> names = render::renderer_names();
  if (std::find(names.begin(), names.end(), value) == names.end()) {
    std::erase(names, "null");  // draws nothing, for tests
    wrong_input(fmt::format("--backend {}: unknown; known are {}", value, joined(names)));
  }
  o.backend = value;
}

void apply_threads(Options& o, const std::string& value) {
  int n = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, n);
  if (error != std::errc() || stop != end || n < 1 || n > most_threads) {
    wrong_input(fmt::format("--threads {}: must be a whole number in 1 .. {}", value, most_threads));
  }
  o.threads = n;
}

void apply_states(Options& o, const std::string& value) {
  int n = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, n);
  if (error != std::errc() || stop != end || n < 0) {
    wrong_input(fmt::format("--states {}: must be a whole number, 0 or more", value));
  }
  o.states_every = n;
}

void apply_every(Options& o, const std::string& value) {
  int n = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, n);
  if (error != std::errc() || stop != end || n < 1)
    wrong_input(fmt::format("--every {}: must be a whole number, 1 or more", value));
  o.every = n;
}

/// X0,Y0,X1,Y1; whether it is in the picture the scene tells.
void apply_region(Options& o, const std::string& value) {
  std::vector<int> numbers;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t comma = std::min(value.find(',', begin), value.size());
    int n = -1;
    const char* end = value.data() + comma;
    const auto [stop, error] = std::from_chars(value.data() + begin, end, n);
    if (error != std::errc() || stop != end || n < 0) numbers.clear();
    if (error != std::errc() || stop != end || n < 0) break;
    numbers.push_back(n);
    begin = comma + 1;
  }
  if (numbers.size() != 4 || numbers[0] >= numbers[2] || numbers[1] >= numbers[3]) {
    wrong_input(fmt::format(
        "--region {}: must be X0,Y0,X1,Y1 in pixels from the top left corner, X0 < X1, Y0 < Y1", value));
  }
  o.region = std::move(numbers);
}

void apply_levels(Options& o, const std::string& value) {
  if (value.size() != 1 || value[0] < '0' || value[0] > '9')
    wrong_input(fmt::format("--levels {}: must be a whole number in 0 .. 9", value));
  o.levels = value[0] - '0';
}

void apply_order(Options& o, const std::string& value) {
  if (value != "1" && value != "2")
    wrong_input(fmt::format("--order {}: must be 1 (4-node tetrahedra) or 2 (10-node)", value));
  o.order = value[0] - '0';
}

void apply_preset(Options& o, const std::string& value) {
  const std::vector<std::string> names = preset_names();
  if (std::find(names.begin(), names.end(), value) == names.end()) {
    wrong_input(fmt::format("--preset {}: unknown; known are {}", value, joined(names)));
  }
  o.preset = value;
}

/// A name that becomes a folder's.
std::string plain_name(const std::string& value, const char* option) {
  if (non_empty(value, option).find('/') != std::string::npos || value.front() == '.') {
    wrong_input(fmt::format("{} {}: must be a plain name", option, value));
  }
  return value;
}

/// Names between commas.
std::vector<std::string> names_of(const std::string& value, const char* option) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= value.size();) {
    const std::size_t comma = std::min(value.find(',', at), value.size());
    names.push_back(value.substr(at, comma - at));
    if (names.back().empty())
      wrong_input(fmt::format("{} {}: must be names with commas between", option, value));
    at = comma + 1;
  }
  return names;
}

std::string one_of(const std::string& value, const char* option, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), value) == names.end())
    wrong_input(fmt::format("{} {}: unknown; known are {}", option, value, joined(names)));
  return value;
}

void apply_ppd(Options& o, const std::string& value) {
  double n = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, n);
  if (error != std::errc() || stop != end || !(n >= 1 && n <= most_pixels_per_degree)) {
    wrong_input(fmt::format("--ppd {}: must be a number in 1 .. {}", value, most_pixels_per_degree));
  }
  o.pixels_per_degree = n;
}

/// A finite number.
double number(const std::string& value, const char* option) {
  double n = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, n);
  if (error != std::errc() || stop != end || !std::isfinite(n)) {
    wrong_input(fmt::format("{} {}: must be a number", option, value));
  }
  return n;
}

/// "STRAIN:STRESS,STRAIN:STRESS,...".
void apply_data(Options& o, const std::string& value) {
  o.material.data.clear();
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find(',', begin), value.size());
    const std::string pair = value.substr(begin, end - begin);
    const std::size_t colon = pair.find(':');
    if (colon == std::string::npos) {
      wrong_input(fmt::format("--data {}: must be STRAIN:STRESS,STRAIN:STRESS,...", value));
    }
    o.material.data.push_back(
        {number(pair.substr(0, colon), "--data"), number(pair.substr(colon + 1), "--data")});
    begin = end + 1;
  }
}

/// X,Y,Z,STIFFNESS or X,Y,Z,STIFFNESS,EXPONENT.
void apply_fibre(Options& o, const std::string& value) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find(',', begin), value.size());
    numbers.push_back(number(value.substr(begin, end - begin), "--fibre"));
    begin = end + 1;
  }
  if (numbers.size() != 4 && numbers.size() != 5) {
    wrong_input(fmt::format("--fibre {}: must be X,Y,Z,STIFFNESS or X,Y,Z,STIFFNESS,EXPONENT", value));
  }
  o.material.fibre = sim::FibreSettings{.direction = {numbers[0], numbers[1], numbers[2]},
                                        .stiffness = numbers[3],
                                        .exponent = numbers.size() == 5 ? numbers[4] : 0.0};
}

constexpr OptionRow option_rows[] = {
    {"-o,--out", "DIR", " run simulate render check preview plot export compare material ",
     "where what is made is written",
     [](Options& o, const std::string& v) { o.out = non_empty(v, "--out"); }},
    {"-o,--out", "FILE", " refine ", "the mesh to write, in the format of its extension",
     [](Options& o, const std::string& v) { o.out = non_empty(v, "--out"); }},
    {"--levels", "N", " refine ", "how often each tet is split in eight; 1, or with --order 0", apply_levels},
    {"--order", "1|2", " refine ", "linear or quadratic tets; by default as they are", apply_order},
    {"--set", "KEY=VALUE", " run simulate render info ",
     "a scene key, as in body.0.density=500; VALUE is TOML or a string", apply_set},
    {"--set", "KEY=VALUE", " check ", "a key of golden.toml, as in limits.flip_mean=0.02", apply_set},
    {"--frames", "A..B", " run simulate render check approve preview export ",
     "only pictures A to B, both included; or one number",
     [](Options& o, const std::string& v) { o.frames = parse_frames(v); }},
    {"--every", "N", " run render ", "only every Nth picture of them; frames keep their numbers",
     apply_every},
    {"--half", nullptr, " run render ",
     "a draft: half the width and height, a quarter of the samples, to RUN-half",
     [](Options& o, const std::string&) { o.half = true; }},
    {"--region", "BOX", " run render ",
     "only pixels X0,Y0,X1,Y1, without column X1 and row Y1, to RUN-region", apply_region},
    {"--pattern", "NAME", " export ", "of png: names as shot.####.png, # for the digits of frames",
     [](Options& o, const std::string& v) { o.pattern = non_empty(v, "--pattern"); }},
    {"--backend", "NAME", " run render ", "raster or path, instead of the scene's", apply_backend},
    {"--threads", "N", " run simulate render check preview export compare info ",
     "at most N threads; never changes a result", apply_threads},
    {"--video", nullptr, " run render ", "also make RUN/<name>.mp4 of the pictures",
     [](Options& o, const std::string&) { o.video = true; }},
    {"--codec", "NAME", " run render ",
     "h264, h265, vp9, prores, prores4444 (with alpha), webp, gif; implies --video",
     [](Options& o, const std::string& v) {
       o.codec = one_of(v, "--codec", video_codecs());
       o.video = true;
     }},
    {"--static", nullptr, " run simulate ",
     "frame 0 at rest, frame 1 the equilibrium: time.integrator = static",
     [](Options& o, const std::string&) { o.is_static = true; }},
    {"--log-newton", nullptr, " run simulate ", "tell each Newton iteration in RUN/newton.csv",
     [](Options& o, const std::string&) { o.log_newton = true; }},
    {"--force", nullptr, " run simulate render ", "make anew what is there but does not match the scene",
     [](Options& o, const std::string&) { o.force = true; }},
    {"--preset", "NAME", " check ", "exact, lsb, render or mc, instead of the golden's limits", apply_preset},
    {"--variant", "NAME", " check ", "hold frames against this variant of the golden where it has them",
     [](Options& o, const std::string& v) { o.variant = plain_name(v, "--variant"); }},
    {"--variant", "NAME", " approve ", "write to this variant of the golden, as another platform's",
     [](Options& o, const std::string& v) { o.variant = plain_name(v, "--variant"); }},
    {"--report", "FILE", " approve ", "only the frames that failed in this report.json of check",
     [](Options& o, const std::string& v) { o.report = non_empty(v, "--report"); }},
    {"--force", nullptr, " approve ", "renew passing frames too",
     [](Options& o, const std::string&) { o.force = true; }},
    {"--states", "N", " approve ", "for a new golden: keep every Nth frame's state too, for telling causes",
     apply_states},
    {"--prune", nullptr, " approve ", "approve nothing; list goldens of frames that RUN does not have",
     [](Options& o, const std::string&) { o.prune = true; }},
    {"--yes", nullptr, " approve ", "with --prune: delete them",
     [](Options& o, const std::string&) { o.yes = true; }},
    {"--ctest", nullptr, " check ", "print measurements as tags that CTest gives to CDash",
     [](Options& o, const std::string&) { o.ctest = true; }},
    {"--github", nullptr, " check ", "append to $GITHUB_STEP_SUMMARY, and print annotations",
     [](Options& o, const std::string&) { o.github = true; }},
    {"--assets", nullptr, " check ", "report.html's script, style and pictures as files, for strict servers",
     [](Options& o, const std::string&) { o.assets = true; }},
    {"--calibrate", nullptr, " check ",
     "draw RUN anew with other seeds, threads and known faults; propose limits",
     [](Options& o, const std::string&) { o.calibrate = true; }},
    {"--yes", nullptr, " check ", "with --calibrate: write them to GOLDEN/golden.toml, not to RUN/check",
     [](Options& o, const std::string&) { o.yes = true; }},
    {"--ppd", "N", " check compare ", "pixels per degree of visual angle, for FLIP; by default 67.0206",
     apply_ppd},
    {"--columns", "A,B,...", " plot ", "only these columns of energy.csv, or simulation, rendering, writing",
     [](Options& o, const std::string& v) { o.columns = names_of(v, "--columns"); }},
    {"--format", "NAME", " plot ", "svg or png, instead of both",
     [](Options& o, const std::string& v) {
       o.format = one_of(v, "--format", {"svg", "png"});
     }},
    {"--format", "NAME", " export ",
     "a file a frame: vtu, ply, obj, png; one of the whole motion: gltf (.glb), usda; by default vtu",
     [](Options& o, const std::string& v) {
       o.format = one_of(v, "--format", {"vtu", "ply", "obj", "gltf", "usda", "png"});
     }},
    {"--fields", "A,B,...", " export ",
     "von_mises, J, energy_density, displacement, young, poisson, density, body; by default all in vtu",
     [](Options& o, const std::string& v) { o.fields = names_of(v, "--fields"); }},
    {"--heat", "FILE", " compare ", "write where they differ as a PNG; with --out, DIR/heat.png",
     [](Options& o, const std::string& v) { o.heat = non_empty(v, "--heat"); }},
    {"--mend", "OUT", " info ", "write the tet mesh without its stray vertices to OUT",
     [](Options& o, const std::string& v) { o.mend = non_empty(v, "--mend"); }},
    {"--keys", nullptr, " info ", "print the table of scene keys",
     [](Options& o, const std::string&) { o.keys = true; }},
    {"--young", "PA", " material ", "Young's modulus, by default 1e5",
     [](Options& o, const std::string& v) { o.material.young = number(v, "--young"); }},
    {"--poisson", "X", " material ", "Poisson's ratio, by default 0.3",
     [](Options& o, const std::string& v) { o.material.poisson = number(v, "--poisson"); }},
    {"--mu", "PA", " material ", "shear modulus; with --lambda",
     [](Options& o, const std::string& v) { o.material.mu = number(v, "--mu"); }},
    {"--lambda", "PA", " material ", "Lamé's first parameter; with --mu",
     [](Options& o, const std::string& v) { o.material.lambda = number(v, "--lambda"); }},
    {"--moduli", "HOW", " material ", "of neo_hookean: lecture, or matched to young and poisson",
     [](Options& o, const std::string& v) { o.material.moduli = v; }},
    {"--C", "PA", " material ", "of neo_hookean; with --D",
     [](Options& o, const std::string& v) { o.material.C = number(v, "--C"); }},
    {"--D", "PA", " material ", "of neo_hookean; with --C",
     [](Options& o, const std::string& v) { o.material.D = number(v, "--D"); }},
    {"--C10", "PA", " material ", "of mooney_rivlin; with --C01 and --bulk",
     [](Options& o, const std::string& v) { o.material.C10 = number(v, "--C10"); }},
    {"--C01", "PA", " material ", "likewise",
     [](Options& o, const std::string& v) { o.material.C01 = number(v, "--C01"); }},
    {"--bulk", "PA", " material ", "likewise",
     [](Options& o, const std::string& v) { o.material.bulk = number(v, "--bulk"); }},
    {"--preset", "NAME", " material ", "young and poisson of rubber, jelly, muscle, fat or silicone",
     [](Options& o, const std::string& v) { o.material.preset = v; }},
    {"--data", "X:PA,...", " material ", "of stress_strain: nominal strain and stress of uniaxial loading",
     apply_data},
    {"--fibre", "X,Y,Z,PA", " material ",
     "with fibres along X,Y,Z of this stiffness; a fifth number: exponent", apply_fibre},
    {"--F", "NUMBERS", " material ", "one deformation gradient, f00,f01,...,f22; without it: curves",
     [](Options& o, const std::string& v) { o.F = v; }},
    {"--quiet", nullptr,
     " run simulate render check approve preview plot export compare info material refine ",
     "no progress, only errors", [](Options& o, const std::string&) { o.quiet = true; }},
    {"--json", nullptr,
     " run simulate render check approve preview plot export compare info material refine ",
     "print the result as JSON on stdout", [](Options& o, const std::string&) { o.json = true; }},
};

bool knows(const CommandRow& command, const OptionRow& option) {
  return std::string_view(option.commands).find(fmt::format(" {} ", command.name)) != std::string_view::npos;
}

std::string long_name(const OptionRow& option) {
  const std::string_view flags = option.flags;
  return std::string(flags.substr(flags.find("--")));
}

constexpr char statuses[] =
    "Exit status: 0 done, or same; 1 different; 2 wrong usage or input; 3 the simulation could not go on;\n"
    "4 the machine failed (disk full, no ffmpeg); 130 or 143 interrupted.\n";

std::string usage(const CommandRow& command) {
  return fmt::format("lagomorph {} {} [options]", command.name, command.input);
}

std::string option_line(std::string flags, const char* value, const char* meaning) {
  if (flags.starts_with("-o,")) flags = "-o, --out";
  return fmt::format("  {:<18}{}\n", value != nullptr ? flags + " " + value : flags, meaning);
}

/// "label a, b, c", over as many lines as it takes.
std::string list_lines(std::string line, const std::vector<std::string>& names) {
  constexpr std::size_t width = 98;
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string word = names[i] + (i + 1 < names.size() ? "," : "");
    if (line.size() + 1 + word.size() > width) {
      text += line + "\n";
      line = " ";
    }
    line += " " + word;
  }
  return text + line + "\n";
}

/// What the program knows by name, where a command takes it.
std::string known_names(std::string_view command) {
  if (command == "material") return "\n" + list_lines("Models:", sim::material_names());
  if (command != "run" && command != "simulate") return "";
  return "\n" + list_lines("Integrators, time.integrator:", sim::integrator_names()) +
         list_lines("Materials, body.N.material.model:", sim::material_names());
}

std::string command_help(const CommandRow& command) {
  std::string text = fmt::format("Usage: {}\n{}.\n\nOptions:\n", usage(command), command.meaning);
  text[text.find('\n') + 1] = static_cast<char>(std::toupper(command.meaning[0]));
  for (const OptionRow& row : option_rows) {
    if (knows(command, row)) text += option_line(row.flags, row.value, row.meaning);
  }
  text += option_line("--help", nullptr, "this text");
  text += option_line("--version", nullptr, "the program's version");
  return text + known_names(command.name) + fmt::format("\nExample: {}\n{}", command.example, statuses);
}

const CommandRow& find_command(const std::string& name) {
  std::vector<std::string> names;
  for (const CommandRow& row : commands) {
    if (name == row.name) return row;
    names.emplace_back(row.name);
  }
  if (name.starts_with("-")) {
    wrong_input(fmt::format("'{}' where a command is expected ({}); options follow the command", name,
                            joined(names)));
  }
  const std::string near = nearest(name, names);
  wrong_input(fmt::format("unknown command '{}'; {} are {}", name,
                          near.empty() ? "commands" : fmt::format("did you mean '{}'? Commands", near),
                          joined(names)));
}

[[noreturn]] void unknown_option(const CommandRow& command, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  std::vector<std::string> known = {"--help", "--version"};
  for (const OptionRow& row : option_rows) {
    if (knows(command, row)) {
      known.push_back(long_name(row));
    } else if (name == long_name(row)) {
      std::string where;
      for (const CommandRow& other : commands) {
        if (knows(other, row)) where += (where.empty() ? "" : ", ") + std::string(other.name);
      }
      wrong_input(fmt::format("'{}' is no option of {}, only of: {}", name, command.name, where));
    }
  }
  const std::string near = nearest(name, known);
  wrong_input(fmt::format("unknown option '{}' of {}; {}", name, command.name,
                          near.empty() ? "known are " + joined(known) : "did you mean '" + near + "'?"));
}

/// CLI11 says `--out: 1 required TEXT missing`; its other messages are about options that have no such rows.
[[noreturn]] void map_parse_error(const CommandRow& command, const CLI::ParseError& error) {
  const std::string message = error.what();
  for (const OptionRow& row : option_rows) {
    if (row.value != nullptr && message.starts_with(long_name(row) + ":")) {
      wrong_input(fmt::format("{} needs a value: {} {}", long_name(row), long_name(row), row.value));
    }
  }
  wrong_input(fmt::format("{} (usage: {})", message, usage(command)));
}

/// What CLI11 did not take: inputs, and options that nobody knows.
std::vector<std::string> inputs_of(const CommandRow& command, const std::vector<std::string>& remaining) {
  std::vector<std::string> inputs;
  bool only_inputs = false;
  for (const std::string& argument : remaining) {
    if (!only_inputs && argument == "--") {
      only_inputs = true;
    } else if (!only_inputs && argument.size() > 1 && argument.starts_with("-")) {
      unknown_option(command, argument);
    } else {
      inputs.push_back(non_empty(argument, command.input));
    }
  }
  return inputs;
}

void check_inputs(const CommandRow& command, const Options& options) {
  const std::string_view names = command.input;
  const std::size_t all = 1 + static_cast<std::size_t>(std::count(names.begin(), names.end(), ' '));
  const std::size_t needed = options.keys ? 0 : all;
  if (options.inputs.size() < needed) {
    std::string_view missing = names;
    for (std::size_t i = 0; i < options.inputs.size(); ++i) missing.remove_prefix(missing.find(' ') + 1);
    wrong_input(
        fmt::format("{} needs {}{}: {}", command.name, all == 1 ? "a " : "", missing, usage(command)));
  }
  if (options.inputs.size() > needed) {
    wrong_input(fmt::format("unexpected argument '{}': {}", options.inputs[needed], usage(command)));
  }
}

}  // namespace

FrameRange parse_frames(const std::string& text, const std::string& what) {
  const auto number = [&](std::string_view digits) {
    int n = -1;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, n);
    if (error != std::errc() || stop != end || n < 0) {
      wrong_input(fmt::format("{}{}: must be A..B or one number, counted from 0", what, text));
    }
    return n;
  };
  const std::string_view all = text;
  const std::size_t dots = all.find("..");
  if (dots == std::string_view::npos) {
    const int n = number(all);
    return {n, n};
  }
  const FrameRange range{number(all.substr(0, dots)), number(all.substr(dots + 2))};
  if (range.first > range.last) {
    wrong_input(
        fmt::format("{}{}: the first frame, {}, is after the last, {}", what, text, range.first, range.last));
  }
  return range;
}

std::string program_help() {
  std::string text =
      "Usage: lagomorph COMMAND [options]\n"
      "Animates hyperelastic tetrahedral meshes, from a scene file to pictures. Needs no display.\n"
      "\nCommands:\n";
  for (const CommandRow& row : commands) {
    text += fmt::format("  {:<21}{}\n", fmt::format("{} {}", row.name, row.input), row.meaning);
  }
  text += "  COMMAND --help       the options of a command\n  --version            the program's version\n";
  return text + "\nExample: lagomorph run bunny --video\n" + statuses;
}

CommandLine parse_command_line(std::span<const std::string> arguments) {
  if (arguments.empty()) wrong_input("no command given; lagomorph --help lists them");
  if (arguments[0] == "-h" || arguments[0] == "--help") return {.text = program_help()};
  const std::string version_text = fmt::format("lagomorph {}\n", version());
  if (arguments[0] == "--version") return {.text = version_text};
  const CommandRow& command = find_command(arguments[0]);

  CLI::App parser;
  parser.allow_extras();
  parser.set_help_flag("-h,--help");
  bool wants_version = false;
  parser.add_flag("--version", wants_version);
  struct Given {
    const OptionRow* row;
    std::vector<std::string> values;
    CLI::Option* option;
  };
  std::vector<std::unique_ptr<Given>> given;  // CLI11 keeps the addresses
  for (const OptionRow& row : option_rows) {
    if (!knows(command, row)) continue;
    Given& g = *given.emplace_back(std::make_unique<Given>(Given{&row, {}, nullptr}));
    g.option = row.value == nullptr
                   ? parser.add_flag(row.flags)->disable_flag_override()
                   : parser.add_option(row.flags, g.values)->expected(1)->take_all()->allow_extra_args(false);
  }
  try {
    // CLI11 takes them last first.
    parser.parse(std::vector<std::string>(arguments.rbegin(), std::prev(arguments.rend())));
  } catch (const CLI::CallForHelp&) {
    return {.text = command_help(command)};
  } catch (const CLI::ParseError& error) {
    map_parse_error(command, error);
  }
  if (wants_version) return {.text = version_text};

  CommandLine line{.text = {}, .command = command.run, .options = {}};
  line.options.command = command.name;
  line.options.inputs = inputs_of(command, parser.remaining());
  for (const auto& g : given) {  // in order, so that of an option given twice the last wins
    if (g->row->value == nullptr && g->option->count() > 0) g->row->apply(line.options, "");
    for (const std::string& value : g->values) g->row->apply(line.options, value);
  }
  check_inputs(command, line.options);
  return line;
}

}  // namespace lagomorph::apps
