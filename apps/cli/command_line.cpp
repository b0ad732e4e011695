#include "apps/cli/command_line.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/cli/option_table.h"
#include "apps/commands.h"
#include "apps/nearest.h"
#include "apps/version.h"
#include "sim/integrator.h"
#include "sim/materials/table.h"

namespace lagomorph::apps {
namespace {

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
  for (const OptionRow& row : option_table()) {
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
  std::string where;
  for (const OptionRow& row : option_table()) {
    if (knows(command, row)) known.push_back(long_name(row));
    if (name != long_name(row)) continue;
    for (const CommandRow& other : commands) {
      if (knows(other, row)) where += (where.empty() ? "" : ", ") + std::string(other.name);
    }
  }
  if (!where.empty())
    wrong_input(fmt::format("'{}' is no option of {}, only of: {}", name, command.name, where));
  const std::string near = nearest(name, known);
  wrong_input(fmt::format("unknown option '{}' of {}; {}", name, command.name,
                          near.empty() ? "known are " + joined(known) : "did you mean '" + near + "'?"));
}

/// CLI11 says `--out: 1 required TEXT missing`; its other messages are about options that have no such rows.
[[noreturn]] void map_parse_error(const CommandRow& command, const CLI::ParseError& error) {
  const std::string message = error.what();
  for (const OptionRow& row : option_table()) {
    if (row.value != nullptr && message.starts_with(long_name(row) + ":")) {
      wrong_input(fmt::format("{} needs a value: {} {}", long_name(row), long_name(row), row.value));
    }
  }
  wrong_input(fmt::format("{} (usage: {})", message, usage(command)));
}

bool has_name(const OptionRow& option, std::string_view name) {
  return fmt::format(",{},", option.flags).find(fmt::format(",{},", name)) != std::string::npos;
}

/// CLI11 takes the next argument for the value of `--name=`, an option too.
void refuse_empty_values(const CommandRow& command, std::span<const std::string> arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") return;
    if (!argument.starts_with("--") || argument.find('=') != argument.size() - 1) continue;
    const std::string name = argument.substr(0, argument.size() - 1);
    for (const OptionRow& row : option_table()) {
      if (row.value != nullptr && knows(command, row) && has_name(row, name))
        wrong_input(fmt::format("{} needs a value: {} {}", name, name, row.value));
    }
  }
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
  for (const OptionRow& row : option_table()) {
    if (!knows(command, row)) continue;
    Given& g = *given.emplace_back(std::make_unique<Given>(Given{&row, {}, nullptr}));
    g.option = row.value == nullptr
                   ? parser.add_flag(row.flags)->disable_flag_override()
                   : parser.add_option(row.flags, g.values)->expected(1)->take_all()->allow_extra_args(false);
  }
  refuse_empty_values(command, arguments.subspan(1));
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
