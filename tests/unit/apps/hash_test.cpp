#include "apps/hash.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace hash_test {

// FIPS 180-2, appendix B.
constexpr char empty[] = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr char abc[] = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr char million_a[] = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(Sha256, MeetsTheStandardsExamples) {
  EXPECT_EQ(sha256(""), empty);
  EXPECT_EQ(sha256("abc"), abc);
  EXPECT_EQ(sha256(std::string(1000000, 'a')), million_a);
}

TEST(Sha256, DoesNotDependOnThePieces) {
  Sha256 hash;
  for (int i = 0; i < 1000; ++i) hash.add(std::string(1000, 'a'));
  EXPECT_EQ(hash.hex(), million_a);
}

TEST(Sha256, OfAFile) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "hash_test_file";
  std::ofstream(file, std::ios::binary) << std::string(1000000, 'a');
  EXPECT_EQ(sha256_file(file), million_a);
  std::ofstream(file, std::ios::binary | std::ios::trunc).flush();
  EXPECT_EQ(sha256_file(file), empty);
  std::filesystem::remove(file);
}

TEST(Sha256, AFileThatCannotBeReadIsWrongInput) {
  for (const char* bad : {"/no/such/file", "/"}) {
    try {
      sha256_file(bad);
      ADD_FAILURE() << bad;
    } catch (const Error& e) {
      EXPECT_EQ(e.status, ExitStatus::wrong_input);
      EXPECT_NE(std::string(e.what()).find(std::string(bad) + ": cannot be read: "), std::string::npos)
          << e.what();
    }
  }
}

}  // namespace hash_test
}  // namespace lagomorph::apps
