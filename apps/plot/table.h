#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lagomorph::apps {

/// Numbers by columns, as in a CSV file with a line of names first.
struct NumberTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  // of one size

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// nullptr when there is none of that name.
  const std::vector<double>* find(std::string_view name) const;
};

/// Reads CSV of plain numbers; what is no number, an empty cell among it, is NaN. Throws Error(wrong_input),
/// prefixed by `what`, for a line with another number of cells.
NumberTable read_table(std::string_view text, const std::string& what);

}  // namespace lagomorph::apps
