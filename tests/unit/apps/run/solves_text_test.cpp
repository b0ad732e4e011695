#include "apps/run/solves_text.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace solves_text_test {

TEST(SolvesText, TellsTheWayThatWasChosen) {
  EXPECT_EQ(way_text({}), "");
  EXPECT_EQ(way_text({.cg_iterations = 3}), "conjugate gradients");
  EXPECT_EQ(way_text({.factorizations = 2, .factor_iterations = 9}), "Cholesky factorizations");
  EXPECT_EQ(way_text({.factor_iterations = 9}), "a Cholesky factorization at rest");
  EXPECT_EQ(way_text({2, 3, 0}), "conjugate gradients and Cholesky factorizations");
}

TEST(SolvesText, TellsTheNumbers) {
  EXPECT_EQ(solves_text({}), "none");
  EXPECT_EQ(solves_text({.cg_iterations = 1204}), "1204 iterations of conjugate gradients, no factorization");
  EXPECT_EQ(solves_text({.factor_iterations = 9}), "no factorization and 9 iterations with a factor kept");
  EXPECT_EQ(solves_text({2, 0, 9}), "2 factorizations and 9 iterations with a factor kept");
}

}  // namespace solves_text_test
}  // namespace lagomorph::apps
