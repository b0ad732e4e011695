#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace lagomorph::apps {

/// Threads of which the first failure ends all.
class Workers {
public:
  /// `on_failure` makes the other threads end; it may be called from any of them, more than once.
  explicit Workers(std::function<void()> on_failure) : on_failure_(std::move(on_failure)) {}
  ~Workers() {
    if (!threads_.empty()) on_failure_();  // not finished: something threw
    for (std::thread& thread : threads_) thread.join();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Runs `work` in a thread of its own.
  void start(std::function<void()> work) {
    threads_.emplace_back([this, work = std::move(work)] { guard(work); });
  }
  /// Runs `work` in this thread.
  void guard(const std::function<void()>& work) {
    try {
      work();
    } catch (...) {
      {
        const std::lock_guard lock(mutex_);
        if (!first_) first_ = std::current_exception();
      }
      on_failure_();
    }
  }
  /// Waits for all, and gives what the first that failed threw; none when all went well.
  std::exception_ptr finish() {
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
    return first_;
  }

private:
  std::function<void()> on_failure_;
  std::mutex mutex_;
  std::exception_ptr first_;
  std::vector<std::thread> threads_;
};

}  // namespace lagomorph::apps
