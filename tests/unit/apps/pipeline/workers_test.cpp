#include "apps/pipeline/workers.h"

#include <atomic>
#include <exception>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "apps/pipeline/bounded_queue.h"

namespace lagomorph::apps {
namespace workers_test {

std::string message(const std::exception_ptr& error) {
  if (!error) return "";
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& e) {
    return e.what();
  }
}

TEST(Workers, DoTheirWork) {
  std::atomic<int> done = 0;
  Workers workers([] {});
  for (int i = 0; i < 3; ++i) workers.start([&] { ++done; });
  workers.guard([&] { ++done; });
  EXPECT_EQ(message(workers.finish()), "");
  EXPECT_EQ(done, 4);
}

TEST(Workers, TheFirstFailureEndsAll) {
  BoundedQueue<int> queue(1);
  Workers workers([&] { queue.abandon(); });
  workers.start([&] {
    while (queue.push(1)) {
    }
    throw std::runtime_error("second");
  });
  workers.guard([&] {
    queue.pop();
    throw std::runtime_error("first");
  });
  EXPECT_EQ(message(workers.finish()), "first");
}

TEST(Workers, ThatAreNotFinishedEndToo) {
  BoundedQueue<int> queue(1);
  bool ended = false;
  {
    Workers workers([&] { queue.abandon(); });
    workers.start([&] {
      queue.pop();
      ended = true;
    });
  }
  EXPECT_TRUE(ended);
}

}  // namespace workers_test
}  // namespace lagomorph::apps
