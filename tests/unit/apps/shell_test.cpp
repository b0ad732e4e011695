#include "apps/shell.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace shell_test {

TEST(ShellWord, LeavesWhatIsPlain) { EXPECT_EQ(shell_word("out/bunny-2_a.png"), "out/bunny-2_a.png"); }

TEST(ShellWord, QuotesTheRest) {
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("-o"), "'-o'");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's; rm *"), "'it'\\''s; rm *'");
  EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
}

}  // namespace shell_test
}  // namespace lagomorph::apps
