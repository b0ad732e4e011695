#include "apps/run/lock.h"

#include <optional>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace lock_test {

using Kind = RunLock::Kind;

TEST(RunLock, OneWritesAtATime) {
  const tests::TemporaryDirectory dir;
  std::optional<RunLock> first(dir.path());
  RunLock second(dir.path());
  first->take(Kind::exclusive);
  EXPECT_TRUE(first->is_exclusive());
  EXPECT_FALSE(second.try_take(Kind::exclusive));
  EXPECT_FALSE(second.try_take(Kind::shared));
  EXPECT_THROW(second.take(Kind::exclusive), Error);
  first.reset();
  EXPECT_TRUE(second.try_take(Kind::exclusive));
}

TEST(RunLock, ManyShare) {
  const tests::TemporaryDirectory dir;
  RunLock first(dir.path()), second(dir.path());
  first.take(Kind::shared);
  EXPECT_TRUE(second.try_take(Kind::shared));
  EXPECT_FALSE(second.is_exclusive());
  EXPECT_FALSE(second.try_take(Kind::exclusive));
  EXPECT_TRUE(first.try_take(Kind::exclusive)) << "the second holds none any more";
  first.take(Kind::shared);
  EXPECT_TRUE(second.try_take(Kind::shared));
}

TEST(RunLock, LeavesNoFile) {
  const tests::TemporaryDirectory dir;
  RunLock lock(dir.path());
  lock.take(Kind::exclusive);
  const RunLock moved = std::move(lock);
  EXPECT_TRUE(moved.is_exclusive());
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

}  // namespace lock_test
}  // namespace lagomorph::apps
