#include "sim/io/base64.h"

#include <gtest/gtest.h>

namespace lagomorph::sim::io {
namespace base64_test {

TEST(Base64, EncodesTheVectorsOfRfc4648) {
  const std::string bytes = "foobar";
  const std::string_view encoded[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t n = 0; n <= bytes.size(); ++n) {
    EXPECT_EQ(base64_encode(bytes.substr(0, n)), encoded[n]);
    std::string decoded;
    EXPECT_TRUE(Base64Reader(encoded[n]).read(n, decoded));
    EXPECT_EQ(decoded, bytes.substr(0, n));
    EXPECT_FALSE(Base64Reader(encoded[n]).read(n + 1, decoded));
  }
}

TEST(Base64, ReadsPiecesAndParts) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  const std::string text = base64_encode(bytes.substr(0, 100)) + "\n " + base64_encode(bytes.substr(100));
  Base64Reader reader(text);
  std::string decoded;
  for (const std::size_t size : {1u, 7u, 91u, 2u, 155u}) EXPECT_TRUE(reader.read(size, decoded));
  EXPECT_EQ(decoded, bytes);
}

TEST(Base64, RefusesWhatIsNone) {
  std::string decoded;
  for (const char* text : {"Zm9", "Zm=v", "Z===", "====", "Zm9!", "Zm9-"}) {
    EXPECT_FALSE(Base64Reader(text).read(3, decoded)) << text;
  }
}

}  // namespace base64_test
}  // namespace lagomorph::sim::io
