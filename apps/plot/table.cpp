#include "apps/plot/table.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

double number(std::string_view cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_whole = error == std::errc() && end == cell.data() + cell.size();
  return is_whole ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const std::vector<double>* NumberTable::find(std::string_view name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? nullptr : &columns[static_cast<std::size_t>(at - names.begin())];
}

NumberTable read_table(std::string_view text, const std::string& what) {
  NumberTable table;
  for (int line_number = 1; !text.empty(); ++line_number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    const std::vector<std::string_view> cells = split(line);
    if (table.names.empty()) {
      table.names.assign(cells.begin(), cells.end());
      table.columns.resize(cells.size());
      continue;
    }
    if (cells.size() != table.names.size()) {
      wrong_input(fmt::format("{}:{}: has {} cells; the first line names {}", what, line_number, cells.size(),
                              table.names.size()));
    }
    for (std::size_t c = 0; c < cells.size(); ++c) table.columns[c].push_back(number(cells[c]));
  }
  return table;
}

}  // namespace lagomorph::apps
