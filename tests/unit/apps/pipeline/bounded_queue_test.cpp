#include "apps/pipeline/bounded_queue.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace bounded_queue_test {

TEST(BoundedQueue, HandsOverInOrderAndNeverHoldsMore) {
  BoundedQueue<int> queue(2);
  std::atomic<int> pushed = 0, popped = 0, most = 0;
  std::thread producer([&] {
    for (int i = 0; i < 1000; ++i) {
      queue.push(i);
      ++pushed;
    }
    queue.close();
  });
  std::vector<int> values;
  while (const auto value = queue.pop()) {
    values.push_back(*value);
    ++popped;
    most = std::max(most.load(), pushed - popped);
  }
  producer.join();
  ASSERT_EQ(values.size(), 1000U);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(values[static_cast<std::size_t>(i)], i);
  EXPECT_LE(most, 2);
}

TEST(BoundedQueue, ClosingHandsOutWhatWaits) {
  BoundedQueue<std::unique_ptr<int>> queue(4);
  EXPECT_TRUE(queue.push(std::make_unique<int>(1)));
  queue.close();
  EXPECT_FALSE(queue.push(std::make_unique<int>(2)));
  EXPECT_EQ(**queue.pop(), 1);
  EXPECT_FALSE(queue.pop().has_value());
}

TEST(BoundedQueue, AbandoningFreesWhoWaits) {
  BoundedQueue<int> full(1), empty(1);
  full.push(1);
  bool pushed = true;
  bool popped = true;
  std::thread producer([&] { pushed = full.push(2); });
  std::thread consumer([&] { popped = empty.pop().has_value(); });
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  full.abandon();
  empty.abandon();
  producer.join();
  consumer.join();
  EXPECT_FALSE(pushed);
  EXPECT_FALSE(popped);
  EXPECT_FALSE(full.pop().has_value());
}

}  // namespace bounded_queue_test
}  // namespace lagomorph::apps
