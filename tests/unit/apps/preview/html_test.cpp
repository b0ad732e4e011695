#include "apps/page/html.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace html_test {

TEST(Html, KeepsTextFromMeaningAnything) {
  EXPECT_EQ(html_text("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c&#39;");
  EXPECT_EQ(html_text("Lamé \x01\x1b[0m"), "Lamé [0m");
  EXPECT_EQ(html_text("\xff"), "\xEF\xBF\xBD");
}

TEST(Html, HoldsBytesAsBase64) {
  // [RFC 4648, section 10]
  EXPECT_EQ(data_uri("a/b", ""), "data:a/b;base64,");
  EXPECT_EQ(data_uri("a/b", "f"), "data:a/b;base64,Zg==");
  EXPECT_EQ(data_uri("a/b", "fo"), "data:a/b;base64,Zm8=");
  EXPECT_EQ(data_uri("a/b", "foobar"), "data:a/b;base64,Zm9vYmFy");
  EXPECT_EQ(data_uri("a/b", "\xff\xfe\xfb"), "data:a/b;base64,//77");
}

}  // namespace html_test
}  // namespace lagomorph::apps
