#include "apps/cli/option_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "apps/check/limits.h"
#include "apps/cli/command_line.h"
#include "apps/error.h"
#include "apps/frame_names.h"
#include "apps/nearest.h"
#include "apps/video/video.h"
#include "render/renderer.h"
#include "sim/integrator.h"
#include "sim/materials/table.h"

namespace lagomorph::apps {
namespace {

constexpr int most_threads = 1024;
constexpr int most_pixels_per_degree = 1000;  // FLIP's

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

/// 0 or more, with nothing else in the text.
std::optional<int> whole_number(std::string_view text) {
  int n = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, n);
  if (error != std::errc() || stop != end || n < 0) return std::nullopt;
  return n;
}

void apply_threads(Options& o, const std::string& value) {
  const std::optional<int> n = whole_number(value);
  if (!n || *n < 1 || *n > most_threads) {
    wrong_input(fmt::format("--threads {}: must be a whole number in 1 .. {}", value, most_threads));
  }
  o.threads = *n;
}

void apply_color_frame(Options& o, const std::string& value) {
  const std::optional<int> n = whole_number(value);
  if (!n) wrong_input(fmt::format("--color-frame {}: must be one frame, counted from 0", value));
  o.color_frame = *n;
}

void apply_states(Options& o, const std::string& value) {
  const std::optional<int> n = whole_number(value);
  if (!n) {
    wrong_input(fmt::format("--states {}: must be a whole number, 0 or more", value));
  }
  o.states_every = *n;
}

void apply_every(Options& o, const std::string& value) {
  const std::optional<int> n = whole_number(value);
  if (!n || *n < 1) wrong_input(fmt::format("--every {}: must be a whole number, 1 or more", value));
  o.every = *n;
}

/// X0,Y0,X1,Y1; whether it is in the picture the scene tells.
void apply_region(Options& o, const std::string& value) {
  std::vector<int> numbers;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t comma = std::min(value.find(',', begin), value.size());
    const std::optional<int> n = whole_number(std::string_view(value).substr(begin, comma - begin));
    if (!n) numbers.clear();
    if (!n) break;
    numbers.push_back(*n);
    begin = comma + 1;
  }
  if (numbers.size() != 4 || numbers[0] >= numbers[2] || numbers[1] >= numbers[3]) {
    wrong_input(fmt::format(
        "--region {}: must be X0,Y0,X1,Y1 in pixels from the top left corner, X0 < X1, Y0 < Y1", value));
  }
  o.region = std::move(numbers);
}

void apply_pattern(Options& o, const std::string& value) {
  o.pattern = FrameNames(non_empty(value, "--pattern")).pattern();
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
     "a scene key, as in body.0.density=500; with no VALUE, it is taken away", apply_set},
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
    {"--pattern", "NAME", " run render ",
     "names of the pictures, as shot.####.png, # for the digits of frames", apply_pattern},
    {"--pattern", "NAME", " export ", "of png: names as shot.####.png, # for the digits of frames",
     apply_pattern},
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
    {"--profile", nullptr, " run simulate render ", "print what the time went into, stage by stage",
     [](Options& o, const std::string&) { o.profile = true; }},
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
    {"--color-frame", "N", " export ",
     "of gltf: the frame of a field's colours; by default where values spread most", apply_color_frame},
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

}  // namespace

std::span<const OptionRow> option_table() { return option_rows; }

std::string non_empty(const std::string& value, const char* option) {
  if (value.empty()) wrong_input(fmt::format("{} is empty", option));
  return value;
}

FrameRange parse_frames(const std::string& text, const std::string& what) {
  const auto number = [&](std::string_view digits) {
    const std::optional<int> n = whole_number(digits);
    if (!n) wrong_input(fmt::format("{}{}: must be A..B or one number, counted from 0", what, text));
    return *n;
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

}  // namespace lagomorph::apps
