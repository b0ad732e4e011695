#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lagomorph::apps {

struct ProcessResult {
  bool found = true;         // the program is on the PATH
  int status = 0;            // exit status; 128 + signal when one ended it
  std::string error_output;  // its stderr
};

/// Runs a program from the PATH without a shell, its input and output closed, and waits for it. When `stop`
/// says so it is ended. Throws Error(machine) when no process can be had.
ProcessResult run_process(const std::vector<std::string>& command, const std::function<bool()>& stop);

/// A program from the PATH that reads what it is fed; its output is dropped. For one thread, and a program
/// that may fail, for nothing is told of why.
class FedProcess {
public:
  explicit FedProcess(const std::vector<std::string>& command);
  /// Kills it if it is still there.
  ~FedProcess();
  FedProcess(const FedProcess&) = delete;
  FedProcess& operator=(const FedProcess&) = delete;

  /// False: it reads no more, or never began.
  bool feed(std::string_view bytes);
  /// Waits for it after the last was fed. True: it ended well.
  bool finish();

private:
  int child_ = 0;  // 0: none
  int input_ = -1;
};

/// The command as a shell would take it.
std::string shell_text(const std::vector<std::string>& command);

}  // namespace lagomorph::apps
