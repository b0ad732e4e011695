#include "apps/video/process.h"

#include <csignal>
#include <string>

#include <gtest/gtest.h>

#include "apps/pipeline/stopwatch.h"
#include "tests/support/program.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace process_test {

const auto never = [] { return false; };

TEST(Process, TellsHowItEnded) {
  const ProcessResult good = run_process({"true"}, never);
  EXPECT_TRUE(good.found);
  EXPECT_EQ(good.status, 0);
  const ProcessResult bad = run_process({"sh", "-c", "echo heard >&2; echo unheard; exit 7"}, never);
  EXPECT_EQ(bad.status, 7);
  EXPECT_EQ(bad.error_output, "heard\n");
  EXPECT_EQ(run_process({"sh", "-c", "kill -9 $$"}, never).status, 128 + SIGKILL);
}

TEST(Process, ArgumentsAreTheirOwnWords) {
  const tests::TemporaryDirectory dir;
  const std::string name = (dir.path() / "a b'; $(touch no) \"*").string();
  EXPECT_EQ(run_process({"touch", name}, never).status, 0);
  EXPECT_TRUE(std::filesystem::exists(name));
}

TEST(Process, OfNoSuchProgramIsNotFound) {
  EXPECT_FALSE(run_process({"lagomorph-no-such-program"}, never).found);
}

TEST(Process, ReadsNothingFromUs) { EXPECT_EQ(run_process({"cat"}, never).status, 0); }

TEST(Process, EndsWhenAsked) {
  const Stopwatch watch;
  const ProcessResult result = run_process({"sleep", "60"}, [&] { return watch.seconds() > 0.05; });
  EXPECT_EQ(result.status, 128 + SIGTERM);
  EXPECT_LT(watch.seconds(), 10.0);
}

TEST(Process, ShellTextIsWhatAShellTakes) {
  EXPECT_EQ(shell_text({"ffmpeg", "-i", "a/frame_%04d.png"}), "ffmpeg -i a/frame_%04d.png");
  const std::string odd = "a b'c$(d)\\\"*\n";
  const ProcessResult result = run_process({"sh", "-c", shell_text({"printf", "%s", odd}) + " >&2"}, never);
  EXPECT_EQ(result.error_output, odd);
  EXPECT_EQ(shell_text({""}), "''");
}

}  // namespace process_test
}  // namespace lagomorph::apps
