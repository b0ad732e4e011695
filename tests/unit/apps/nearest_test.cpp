#include "apps/nearest.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace nearest_test {

TEST(EditDistance, CountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // the textbook's
  EXPECT_EQ(edit_distance("young", "yuong"), 1);
  EXPECT_EQ(edit_distance("Young", "young"), 0);
  EXPECT_EQ(edit_distance("ca", "abc"), 3);  // of the restricted distance; 2 without the restriction
}

TEST(Nearest, TakesWhatIsNearOnly) {
  const std::vector<std::string> names = {"run", "simulate", "render", "info"};
  EXPECT_EQ(nearest("rn", names), "run");
  EXPECT_EQ(nearest("rnu", names), "run");
  EXPECT_EQ(nearest("simulat", names), "simulate");
  EXPECT_EQ(nearest("rendre", names), "render");
  EXPECT_EQ(nearest("check", names), "");
  EXPECT_EQ(nearest("", names), "");
  EXPECT_EQ(nearest("x", names), "");
  EXPECT_EQ(nearest(std::string(100000, 'x'), names), "");
}

TEST(Nearest, TakesAPartOfAName) {
  const std::vector<std::string> names = {"base_color", "roughness", "ior"};
  EXPECT_EQ(nearest("color", names), "base_color");
  EXPECT_EQ(nearest("roughness_of_it", names), "roughness");
  EXPECT_EQ(nearest("co", names), "");
}

TEST(Joined, PutsCommas) {
  EXPECT_EQ(joined(std::vector<std::string>{}), "");
  EXPECT_EQ(joined(std::vector<std::string>{"a", "b"}), "a, b");
}

}  // namespace nearest_test
}  // namespace lagomorph::apps
