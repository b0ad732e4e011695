#include "apps/plot/run_figures.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/nearest.h"
#include "apps/run/energy_csv.h"
#include "apps/run/paths.h"
#include "apps/run/record.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

enum class Over { time, frame };

/// A figure, and the columns that it shows.
struct Kind {
  const char* name;     // of its file
  const char* columns;  // names between spaces; one that ends with * is the beginning of names
  const char* title;
  const char* label;  // of y
  const char* unit;
  Over over = Over::time;
  bool log = false;
  bool whole = false;
  bool alone = true;  // drawn where no columns are asked for
};
constexpr Kind kinds[] = {
    {"energy", " kinetic elastic gravitational total contact friction springs loads ", "Energy", "energy",
     "J"},
    {"work", " work_* damping_loss dissipated ", "Work and losses", "energy", "J"},
    {"momentum", " momentum_* ", "Linear momentum", "momentum", "kg m/s"},
    {"angular_momentum", " angular_momentum_* ", "Angular momentum", "angular momentum", "kg m^2/s"},
    {"pin_force", " pin_force_* ", "Force of the pins", "force", "N"},
    {"determinant", " min_J max_J ", "Volume ratio of the worst element", "J = det F", ""},
    {"newton", " newton_iterations steps rejected halvings ", "Steps and Newton iterations", "number a frame",
     "", Over::frame, false, true},
    {"residual", " residual ", "Largest residual of Newton's method", "residual over weight", "", Over::frame,
     true},
    {"seconds", " simulation rendering writing ", "Time spent on a frame", "time", "s", Over::frame, true},
    {"mass", " mass ", "Mass", "mass", "kg", Over::time, false, false, false},
};

/// Whether the kind shows this column.
bool shows(const Kind& kind, std::string_view column) {
  std::string_view rest = kind.columns;
  while (rest.size() > 1) {
    rest.remove_prefix(1);
    const std::string_view name = rest.substr(0, rest.find(' '));
    if (name.ends_with('*') ? column.starts_with(name.substr(0, name.size() - 1)) : column == name)
      return true;
    rest.remove_prefix(name.size());
  }
  return false;
}

/// "newton iterations".
std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

bool is_place(std::string_view column) { return column == "frame" || column == "time"; }

void require(const NumberTable& table, const std::vector<std::string>& columns) {
  std::vector<std::string> known;
  for (const std::string& name : table.names) {
    if (!is_place(name)) known.push_back(name);
  }
  for (const std::string& name : columns) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearest(name, known);
    wrong_input(fmt::format("--columns: there is no column '{}'; {}columns are {}", name,
                            near.empty() ? "" : fmt::format("did you mean '{}'? ", near), joined(known)));
  }
}

Axis place_axis(Over over) {
  if (over == Over::time) return {.label = "time", .unit = "s"};
  return {.label = "frame", .whole = true};
}

/// The figure of the columns; a curve alone gives it its title.
Figure figure_of(const NumberTable& table, const std::vector<std::size_t>& columns, const Kind& kind) {
  Figure figure{.title = kind.title,
                .x = place_axis(kind.over),
                .y = {.label = kind.label, .unit = kind.unit, .log = kind.log, .whole = kind.whole},
                .curves = {}};
  const std::vector<double>& x = *table.find(kind.over == Over::time ? "time" : "frame");
  for (const std::size_t c : columns) figure.curves.push_back({words(table.names[c]), x, table.columns[c]});
  if (columns.size() == 1) {  // no name at its end
    figure.title = figure.curves[0].name;
    figure.title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(figure.title[0])));
  }
  return figure;
}

void add_seconds(NumberTable& table, const std::map<int, FrameRecord>& records) {
  const std::vector<double>* frames = table.find("frame");
  if (records.empty() || frames == nullptr) return;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> simulation, rendering, writing;
  for (const double frame : *frames) {
    const auto r = records.find(static_cast<int>(frame));
    const bool made = r != records.end() && r->second.state, drawn = r != records.end() && r->second.picture;
    simulation.push_back(made && frame > 0 ? r->second.state->seconds : none);
    rendering.push_back(drawn ? r->second.picture->rendering_seconds : none);
    writing.push_back(drawn ? r->second.picture->writing_seconds : none);
  }
  const auto is_number = [](double v) { return v == v; };
  const auto add = [&](const char* name, std::vector<double> values) {
    if (std::none_of(values.begin(), values.end(), is_number)) return;
    table.names.emplace_back(name);
    table.columns.push_back(std::move(values));
  };
  add("simulation", std::move(simulation));
  add("rendering", std::move(rendering));
  add("writing", std::move(writing));
}

}  // namespace

NumberTable read_run_table(const fs::path& run) {
  const RunPaths paths(run);
  std::error_code error;
  if (!fs::is_directory(run, error)) {
    wrong_input(run.string() + (fs::exists(run, error) ? ": is a file; plot takes a run's folder"
                                                       : ": there is no such run"));
  }
  std::map<int, FrameRecord> records = read_records(paths);
  if (records.empty()) records = read_gathered_records(paths);
  const bool written = fs::exists(paths.energy(), error);
  NumberTable table =
      read_table(written ? read_file(paths.energy()) : energy_csv(records), paths.energy().string());
  for (const char* column : {"frame", "time"}) {
    if (table.find(column) == nullptr)
      wrong_input(fmt::format("{}: has no column '{}'; it must be a run's", paths.energy().string(), column));
  }
  if (table.rows() == 0)
    wrong_input(fmt::format("{}: has no frame to plot; `lagomorph run` makes them", run.string()));
  add_seconds(table, records);
  return table;
}

std::vector<NamedFigure> run_figures(const NumberTable& table, const std::vector<std::string>& columns) {
  require(table, columns);
  const auto asked = [&](const std::string& name) {
    return std::find(columns.begin(), columns.end(), name) != columns.end();
  };
  std::vector<NamedFigure> figures;
  std::vector<bool> drawn(table.names.size());
  for (const Kind& kind : kinds) {
    std::vector<std::size_t> of_kind;
    for (std::size_t c = 0; c < table.names.size(); ++c) {
      if (drawn[c] || is_place(table.names[c]) || !shows(kind, table.names[c])) continue;
      drawn[c] = true;
      if (columns.empty() ? kind.alone : asked(table.names[c])) of_kind.push_back(c);
    }
    if (!of_kind.empty()) figures.push_back({kind.name, figure_of(table, of_kind, kind)});
  }
  for (std::size_t c = 0; c < table.names.size(); ++c) {  // what no kind knows
    const std::string& name = table.names[c];
    if (drawn[c] || is_place(name) || !(columns.empty() || asked(name))) continue;
    const std::string label = words(name);
    std::string file = name;
    std::replace(file.begin(), file.end(), '/', '_');
    figures.push_back({file, figure_of(table, {c}, {"", "", label.c_str(), label.c_str(), ""})});
  }
  return figures;
}

}  // namespace lagomorph::apps
