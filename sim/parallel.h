#pragma once

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

}  // namespace lagomorph::sim
