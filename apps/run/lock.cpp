#include "apps/run/lock.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace {

int operation(RunLock::Kind kind) { return kind == RunLock::Kind::exclusive ? LOCK_EX : LOCK_SH; }

}  // namespace

RunLock::RunLock(const std::filesystem::path& folder)
    : folder_(folder), fd_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {}

RunLock::~RunLock() {
  if (fd_ >= 0) ::close(fd_);
}

RunLock::RunLock(RunLock&& other) noexcept
    : folder_(std::move(other.folder_)), fd_(std::exchange(other.fd_, -1)), exclusive_(other.exclusive_) {}

bool RunLock::try_take(Kind kind) {
  exclusive_ = false;
  if (fd_ >= 0 && ::flock(fd_, operation(kind) | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  exclusive_ = kind == Kind::exclusive;
  return true;
}

void RunLock::take(Kind kind) {
  if (try_take(kind)) return;
  throw Error(
      ExitStatus::wrong_input,
      folder_.string() + ": another lagomorph is writing this run; wait for it, or give another --out");
}

void RunLock::wait_for(Kind kind) {
  while (fd_ >= 0 && ::flock(fd_, operation(kind)) != 0 && errno == EINTR) {
  }
  exclusive_ = kind == Kind::exclusive;
}

}  // namespace lagomorph::apps
