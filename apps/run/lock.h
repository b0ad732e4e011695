#pragma once

#include <filesystem>

namespace lagomorph::apps {

/// Keeps a run's folder to this process while it lives: exclusive for who changes what the run is, shared for
/// those that only draw, each its own frames. The lock is on the folder itself: no file is left, and it goes
/// with the process. File systems without locks lock nothing.
class RunLock {
public:
  enum class Kind { exclusive, shared };

  /// The folder must exist. Nothing is locked yet.
  explicit RunLock(const std::filesystem::path& folder);
  ~RunLock();
  RunLock(RunLock&&) noexcept;
  RunLock& operator=(RunLock&&) = delete;

  /// Takes the lock, or changes its kind. False, and nothing is held, when others are in the way.
  bool try_take(Kind);
  /// The same; throws Error(wrong_input) when others are in the way.
  void take(Kind);
  /// Waits for it.
  void wait_for(Kind);
  bool is_exclusive() const { return exclusive_; }

private:
  std::filesystem::path folder_;
  int fd_ = -1;
  bool exclusive_ = false;
};

}  // namespace lagomorph::apps
