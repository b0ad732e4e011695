#pragma once

#include <span>
#include <string>

#include "apps/cli/options.h"

namespace lagomorph::apps {

struct OptionRow {
  const char* flags;     // as CLI11 takes them
  const char* value;     // what it takes; nullptr for a flag
  const char* commands;  // that know it, between spaces
  const char* meaning;
  void (*apply)(Options&, const std::string&);  // throws Error(wrong_input) for a value that is none
};

/// The explicit table: a new option is one row.
std::span<const OptionRow> option_table();

/// The value, or Error(wrong_input) that names the option.
std::string non_empty(const std::string& value, const char* option);

}  // namespace lagomorph::apps
