#pragma once

#include <functional>

namespace lagomorph::sim {

/// Bounds the threads of the whole process's task pool while it lives. Results never depend on it.
class ThreadLimit {
public:
  explicit ThreadLimit(int threads);  // >= 1
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
  void* control_;
};

/// Calls body(begin, end) on pieces of [0, count), at most `grain` long, on all threads. Each piece must
/// write to places of its own; whoever sums does it afterwards in a fixed order, so that no result depends on
/// the number of threads.
void parallel_for(int count, int grain, const std::function<void(int begin, int end)>& body);

}  // namespace lagomorph::sim
