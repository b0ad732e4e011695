#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>

/// Figures that tests measure on their way, for the tables of tests/README.md. tests/proof.sh sets
/// LAGOMORPH_LEDGER to a folder; without it nothing is written.
namespace lagomorph {

/// Appends a row to a section's table, under `columns` where it is the first.
inline void tell(const std::string& section, std::initializer_list<std::string> columns,
                 std::initializer_list<std::string> cells) {
  const char* folder = std::getenv("LAGOMORPH_LEDGER");
  if (folder == nullptr) return;
  const std::filesystem::path file = std::filesystem::path(folder) / (section + ".md");
  const auto row = [](std::initializer_list<std::string> values) {
    std::string text = "|";
    for (const std::string& value : values) text += " " + value + " |";
    return text + "\n";
  };
  const bool is_first = !std::filesystem::exists(file);
  std::ofstream out(file, std::ios::app);
  if (is_first) {
    out << row(columns) << '|';
    for (std::size_t i = 0; i < columns.size(); ++i) out << "---|";
    out << '\n';
  }
  out << row(cells);
}

/// A figure as it stands in a table: three digits.
inline std::string told(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

}  // namespace lagomorph
