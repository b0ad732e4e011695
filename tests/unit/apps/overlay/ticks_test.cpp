#include "apps/overlay/ticks.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace ticks_test {

using Values = std::vector<double>;

TEST(Ticks, AreRoundAndAroundTheValues) {
  EXPECT_EQ(ticks(0, 6), (Values{0, 2, 4, 6}));
  EXPECT_EQ(ticks(-850, 600), (Values{-1000, -500, 0, 500, 1000}));
  EXPECT_EQ(ticks(0, 1), (Values{0, 0.5, 1}));
  EXPECT_EQ(ticks(0, 3, 6), (Values{0, 0.5, 1, 1.5, 2, 2.5, 3}));
  for (const double high : {1e-9, 0.3, 7.0, 12345.0}) {
    const Values all = ticks(-0.1 * high, high);
    EXPECT_LE(all.front(), -0.1 * high);
    EXPECT_GE(all.back(), high * (1 - 1e-9));
    EXPECT_TRUE(all.size() >= 3 && all.size() <= 8) << high << ": " << all.size();
  }
}

TEST(Ticks, OfDecadesArePowersOfTen) {
  EXPECT_EQ(decade_ticks(0.02, 30), (Values{0.01, 0.1, 1, 10, 100}));
  EXPECT_EQ(decade_ticks(1, 1), (Values{1, 10}));
  EXPECT_EQ(decade_ticks(0.1, 10), (Values{0.1, 1, 10}));
  const Values many = decade_ticks(1e-17, 1e-3);
  EXPECT_LE(many.size(), 9U);
  EXPECT_LE(many.front(), 1e-17 * (1 + 1e-9));
  EXPECT_GE(many.back(), 1e-3 * (1 - 1e-9));
}

}  // namespace ticks_test
}  // namespace lagomorph::apps
