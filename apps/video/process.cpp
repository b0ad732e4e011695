#include "apps/video/process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/error.h"

extern char** environ;

namespace lagomorph::apps {
namespace {

[[noreturn]] void fail(const std::string& program, int error) {
  throw Error(ExitStatus::machine, program + " cannot be started: " + std::strerror(error));
}

constexpr int nothing = -1;  // in place of a file descriptor: /dev/null

/// What the child gets: its input and stderr, no output, default signals, a group of its own so that the
/// terminal's Ctrl-C reaches only us.
class SpawnSettings {
public:
  SpawnSettings(int input, int errors) {
    posix_spawn_file_actions_init(&actions_);
    give(input, STDIN_FILENO, O_RDONLY);
    give(nothing, STDOUT_FILENO, O_WRONLY);
    give(errors, STDERR_FILENO, O_WRONLY);
    posix_spawnattr_init(&attributes_);
    sigset_t defaults;
    sigemptyset(&defaults);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) sigaddset(&defaults, signal);
    posix_spawnattr_setsigdefault(&attributes_, &defaults);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
  void give(int from, int to, int mode) {
    if (from == nothing) {
      posix_spawn_file_actions_addopen(&actions_, to, "/dev/null", mode, 0);
    } else {
      posix_spawn_file_actions_adddup2(&actions_, from, to);
    }
  }

  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// Reads until the child closes its end, ending the child when `stop` says so.
std::string read_until_closed(int fd, pid_t child, const std::function<bool()>& stop) {
  constexpr int look_every = 100;            // [ms]
  constexpr std::size_t most = 1024 * 1024;  // of a program that never stops complaining
  std::string text;
  std::array<char, 4096> buffer;
  for (bool ended = false;;) {
    if (stop() && !ended) {
      ::kill(child, SIGTERM);
      ended = true;
    }
    pollfd watched{fd, POLLIN, 0};
    const int ready = ::poll(&watched, 1, look_every);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t got = ::read(fd, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    if (text.size() < most) text.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

struct Spawned {
  pid_t child = 0;
  int error = 0;  // of errno
  bool not_found() const { return error == ENOENT || error == EACCES || error == ENOTDIR; }
};

Spawned spawn(const std::vector<std::string>& command, const SpawnSettings& settings) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  Spawned spawned;
  spawned.error = ::posix_spawnp(&spawned.child, arguments[0], settings.actions(), settings.attributes(),
                                 arguments.data(), environ);
  return spawned;
}

/// Exit status; 128 + signal when one ended it.
int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command, const std::function<bool()>& stop) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail(command.front(), errno);
  const Spawned spawned = spawn(command, {nothing, ends[1]});
  ::close(ends[1]);
  if (spawned.error != 0) {
    ::close(ends[0]);
    if (spawned.not_found()) return {.found = false, .status = 127, .error_output = {}};
    fail(command.front(), spawned.error);
  }
  ProcessResult result;
  result.error_output = read_until_closed(ends[0], spawned.child, stop);
  ::close(ends[0]);
  result.status = wait_for(spawned.child);
  return result;
}

FedProcess::FedProcess(const std::vector<std::string>& command) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return;
  const Spawned spawned = spawn(command, {ends[0], nothing});
  ::close(ends[0]);
  if (spawned.error != 0) {
    ::close(ends[1]);
    return;
  }
  child_ = spawned.child;
  input_ = ends[1];
}

FedProcess::~FedProcess() {
  if (child_ == 0) return;
  ::kill(child_, SIGKILL);
  finish();
}

bool FedProcess::feed(std::string_view bytes) {
  // A child that has ended is no reason for us to end: SIGPIPE is this thread's for the time being.
  sigset_t broken_pipe, before;
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken_pipe, &before);
  while (child_ != 0 && !bytes.empty()) {
    const ssize_t written = ::write(input_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) break;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  const timespec at_once{};
  while (::sigtimedwait(&broken_pipe, nullptr, &at_once) < 0 && errno == EINTR) {
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return bytes.empty();
}

bool FedProcess::finish() {
  if (child_ == 0) return false;
  ::close(input_);
  return wait_for(std::exchange(child_, 0)) == 0;
}

std::string shell_text(const std::vector<std::string>& command) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  std::string text;
  for (const std::string& argument : command) {
    if (!text.empty()) text += ' ';
    if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) {
      text += argument;
      continue;
    }
    text += '\'';
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

}  // namespace lagomorph::apps
