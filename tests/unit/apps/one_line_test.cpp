#include "apps/one_line.h"

#include <string>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace one_line_test {

TEST(OneLine, EscapesControlCharacters) {
  EXPECT_EQ(one_line("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(one_line("\x1b[31mred\x7f"), "\\x1b[31mred\\x7f");
  EXPECT_EQ(one_line(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(one_line("\xC2\x9B"
                     "31m"),
            "\\xc2\\x9b31m");  // U+009B begins an escape sequence too
}

TEST(OneLine, KeepsText) {
  const std::string text = "caf\u00e9 \u5154 \U0001F430 \u00a0'\"\\";
  EXPECT_EQ(one_line(text), text);
}

}  // namespace one_line_test
}  // namespace lagomorph::apps
