#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"
#include "tests/support/run_tree.h"
#include "tests/support/temporary_directory.h"

/// Runs of the small bar by the program itself.
namespace lagomorph::tests {

using Arguments = std::vector<std::string>;

inline Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class ProgramRun : public testing::Test {
protected:
  /// A place in the test's own folder.
  std::filesystem::path at(const std::string& name) const { return dir_.path() / name; }

  /// Draws black pictures at once; tests of pictures set another.
  std::string backend_ = "null";

  /// `lagomorph run` of the bar, four frames, nothing said.
  Arguments run(const std::string& out, const Arguments& more = {}) const {
    return command("run", out, more);
  }
  Arguments simulate(const std::string& out, const Arguments& more = {}) const {
    return command("simulate", out, more);
  }
  Arguments render(const std::string& of, const Arguments& more = {}) const {
    return Arguments{"render", at(of).string(), "--quiet"} + more;
  }

  /// Runs the program, expects the status, and gives what it said on stderr.
  static std::string expect(int status, const Arguments& arguments, const ProgramOptions& options = {}) {
    const Ended ended = run_program(arguments, options);
    EXPECT_EQ(ended.status, status) << ended.err;
    if (status != 0) {
      EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
      EXPECT_EQ(ended.out, "");
    }
    return ended.err;
  }

  nlohmann::json run_json(const std::string& run) const {
    return nlohmann::json::parse(read_all(at(run) / "run.json"));
  }

  TemporaryDirectory dir_;

private:
  Arguments command(const char* name, const std::string& out, const Arguments& more) const {
    return Arguments{name,     data_file("run/bar.toml").string(), "--set", "time.frames=4",
                     "--set",  "render.backend=" + backend_,       "-o",    at(out).string(),
                     "--quiet"} +
           more;
  }
};

}  // namespace lagomorph::tests
