#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/cli/command_line.h"
#include "apps/scene/scene.h"
#include "apps/version.h"
#include "tests/support/program.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph {
namespace main_test {

using tests::Ended;
using tests::run_program;

/// One line `lagomorph: error: ...` on stderr and nothing on stdout.
void expect_error(const Ended& ended, int status, const std::string& message) {
  EXPECT_EQ(ended.status, status) << ended.err;
  EXPECT_EQ(ended.err, "lagomorph: error: " + message + "\n");
  EXPECT_EQ(ended.out, "");
}

TEST(Program, TellsHelpAndVersion) {
  const tests::TemporaryDirectory directory;
  const Ended help = run_program({"--help"}, directory);
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.out, apps::program_help());
  EXPECT_EQ(help.err, "");
  EXPECT_EQ(run_program({"--version"}, directory).out, "lagomorph " + apps::version() + "\n");
  EXPECT_EQ(run_program({"info", "--keys"}, directory).out, apps::scene_key_table_markdown());
}

TEST(Program, WithoutACommandIsWrongUsage) {
  const tests::TemporaryDirectory directory;
  const Ended ended = run_program({}, directory);
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.out, apps::program_help());
  EXPECT_EQ(ended.err, "lagomorph: error: no command given; lagomorph --help lists them\n");
}

TEST(Program, TellsWrongUsageAndInputByStatus2) {
  const tests::TemporaryDirectory directory;
  expect_error(run_program({"run"}, directory), 2,
               "run needs a SCENE.toml: lagomorph run SCENE.toml [options]");
  const Ended missing = run_program({"run", "no_such.toml"}, directory);
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(
      missing.err.find("lagomorph: error: no_such.toml: there is no such scene; the program's own are "), 0U)
      << missing.err;
  EXPECT_NE(missing.err.find("cantilever"), std::string::npos) << missing.err;
  const std::string scene = directory.write("a.toml", "[[body]]\nmesh = 'a.msh'\nyuong = 3\n").string();
  const std::string message =
      scene + ":3:1: unknown key 'yuong'; did you mean 'young' of [body.material], [body.region.material]?";
  const std::string out = (directory.path() / "out").string();
  expect_error(run_program({"run", scene, "-o", out}, directory), 2, message);
  expect_error(run_program({"simulate", scene, "-o", out}, directory), 2, message);
  expect_error(run_program({"info", scene}, directory), 2, message);
  EXPECT_FALSE(std::filesystem::exists(out));
  expect_error(run_program({"info", directory.path().string()}, directory), 2,
               directory.path().string() + ": is no run: it has no run.json");
  const std::string picture = directory.write("a.png", "").string();
  const Ended ended = run_program({"info", picture}, directory);
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.err.find("lagomorph: error: " + picture + ": neither a scene (.toml), a tet mesh ("), 0U)
      << ended.err;
}

TEST(Program, EscapesWhatItTells) {
  const tests::TemporaryDirectory directory;
  const Ended unknown = run_program({"a\nb\x1b[31m"}, directory);
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(unknown.err.starts_with(
      "lagomorph: error: unknown command 'a\\nb\\x1b[31m'; commands are run, simulate, render, "))
      << unknown.err;
  EXPECT_EQ(std::count(unknown.err.begin(), unknown.err.end(), '\n'), 1);
  const Ended ended = run_program({"run", std::string(100000, 'x')}, directory);
  EXPECT_EQ(ended.status, 2);
  EXPECT_LT(ended.err.size(), 5000U);
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1);
}

TEST(Program, OutputThatCannotBeWrittenIsStatus4) {
  const tests::TemporaryDirectory directory;
  const int full = open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  expect_error(run_program({"info", "--keys"}, directory, full), 4,
               "standard output cannot be written: No space left on device");
  close(full);
}

TEST(Program, AReaderThatLeavesIsNoError) {
  const tests::TemporaryDirectory directory;
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const Ended ended = run_program({"info", "--keys"}, directory, ends[1]);
  close(ends[1]);
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.err, "");
}

}  // namespace main_test
}  // namespace lagomorph
