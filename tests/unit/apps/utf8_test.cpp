#include "apps/utf8.h"

#include <string>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace utf8_test {

TEST(Utf8, TakesTextOfEveryLength) {
  EXPECT_TRUE(is_utf8(""));
  EXPECT_TRUE(is_utf8("plain"));
  EXPECT_TRUE(is_utf8("caf\u00e9 \u5154 \U0001F430"));
  EXPECT_TRUE(is_utf8("\xF4\x8F\xBF\xBF"));  // U+10FFFF, the last
}

TEST(Utf8, RefusesEverythingElse) {
  for (const char* bytes : {"\x80", "\xFF", "a\xC3", "\xE5\x85", "\xC3(", "\xC0\xAF", "\xE0\x80\xAF",
                            "\xED\xA0\x80", "\xF0\x80\x80\xAF", "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80"}) {
    EXPECT_FALSE(is_utf8(bytes)) << bytes;
  }
}

TEST(Utf8, InvalidBytesAreReplaced) {
  EXPECT_EQ(valid_utf8("a\xC3\xA4"), "a\xC3\xA4");
  EXPECT_EQ(valid_utf8("a\xFF\xC3"), "a\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(valid_utf8(""), "");
}

}  // namespace utf8_test
}  // namespace lagomorph::apps
