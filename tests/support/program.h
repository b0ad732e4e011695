#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

/// Drives the built program as a script would.
namespace lagomorph::tests {

inline std::string read_all(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// How a program ended and what it said.
struct Ended {
  int status = -1;  // as a shell sees it: 128 + signal when one ended it
  std::string out;
  std::string err;
};

struct ProgramOptions {
  std::optional<uid_t> user = {};                       // other than ours; only root may choose
  std::filesystem::path directory = {};                 // where it runs; empty: here
  std::map<std::string, std::string> environment = {};  // beside what there is
  rlim_t largest_file = RLIM_INFINITY;                  // [bytes]
  int output = -1;                                      // takes what it prints, instead of the result
};

/// A program that runs; killed when the test leaves it running.
class Program {
public:
  explicit Program(const std::vector<std::string>& arguments, const ProgramOptions& options = {}) {
    char name[] = "/tmp/lagomorph_output_XXXXXX";
    folder_ = ::mkdtemp(name);
    std::vector<std::string> command = {lagomorph::tests::program().string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& argument : command) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) return;
    if (options.output >= 0) {
      ::dup2(options.output, STDOUT_FILENO);
    } else {
      redirect("out", STDOUT_FILENO);
    }
    redirect("err", STDERR_FILENO);
    if (!options.directory.empty() && ::chdir(options.directory.c_str()) != 0) ::_exit(126);
    for (const auto& [key, value] : options.environment) ::setenv(key.c_str(), value.c_str(), 1);
    if (options.largest_file != RLIM_INFINITY) {
      const rlimit limit{options.largest_file, options.largest_file};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (options.user && (::setgid(*options.user) != 0 || ::setuid(*options.user) != 0)) ::_exit(126);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ~Program() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      wait();
    }
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const { ::kill(pid_, number); }
  bool is_running() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == 0;
  }
  /// Waits until something is so while the program runs; false when it ended before.
  bool wait_until(const std::function<bool()>& is_so) const {
    while (!is_so()) {
      if (!is_running()) return is_so();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }
  Ended wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_all(folder_ / "out"),
            read_all(folder_ / "err")};
  }

private:
  void redirect(const char* name, int to) const {
    const int fd = ::open((folder_ / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    ::dup2(fd, to);
    ::close(fd);
  }

  std::filesystem::path folder_;
  pid_t pid_ = -1;
};

inline Ended run_program(const std::vector<std::string>& arguments, const ProgramOptions& options = {}) {
  return Program(arguments, options).wait();
}

inline Ended run_program(const std::vector<std::string>& arguments, const TemporaryDirectory&,
                         int output = -1) {
  return run_program(arguments, {.output = output});
}

}  // namespace lagomorph::tests
