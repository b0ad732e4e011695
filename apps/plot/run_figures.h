#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/plot/figure.h"
#include "apps/plot/table.h"

namespace lagomorph::apps {

/// A figure and its file's name without extension.
struct NamedFigure {
  std::string name;
  Figure figure;
};

/// RUN/energy.csv, or its records where it is not written yet, with the seconds of each stage as further
/// columns: simulation, rendering, writing. Throws Error(wrong_input) when there is nothing to plot.
NumberTable read_run_table(const std::filesystem::path& run);

/// Its columns as figures: those of one kind together, any that is not known in one of its own. `columns`
/// alone, when they are given. Throws Error(wrong_input) for one that is not there.
std::vector<NamedFigure> run_figures(const NumberTable&, const std::vector<std::string>& columns);

}  // namespace lagomorph::apps
