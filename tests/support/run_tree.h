#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/paths.h"
#include "tests/support/program.h"

namespace lagomorph::tests {

inline std::filesystem::path data_file(const std::string& name) {
  return lagomorph::tests::source_dir() / "tests" / "data" / name;
}

/// Every file of a folder by its relative path, as two runs of the same scene have them: without the seconds
/// and the number of threads that records and run.json tell.
inline std::map<std::string, std::string> tree(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string contents = read_all(entry.path());
    if (entry.path().extension() == ".json") {
      nlohmann::json json = nlohmann::json::parse(contents);
      json.erase("seconds");
      if (json.contains("machine")) json["machine"].erase("threads");
      if (json.contains("frames")) {
        for (nlohmann::json& frame : json["frames"]) frame.erase("seconds");
      }
      contents = json.dump(1);
    }
    files[std::filesystem::relative(entry.path(), folder).string()] = std::move(contents);
  }
  return files;
}

/// The same files with the same bytes, told by name.
inline void expect_same_run(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto files_a = tree(a);
  const auto files_b = tree(b);
  for (const auto& [name, contents] : files_a) {
    ASSERT_TRUE(files_b.contains(name)) << name << " is only in " << a;
    EXPECT_TRUE(contents == files_b.at(name)) << name << " differs between " << a << " and " << b;
  }
  for (const auto& [name, contents] : files_b)
    EXPECT_TRUE(files_a.contains(name)) << name << " is only in " << b;
}

inline int count_files(const std::filesystem::path& folder) {
  int n = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    n += entry.is_regular_file() ? 1 : 0;
  return n;
}

}  // namespace lagomorph::tests
