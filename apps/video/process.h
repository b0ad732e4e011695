#pragma once

#include <functional>
#include <string>
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

/// The command as a shell would take it.
std::string shell_text(const std::vector<std::string>& command);

}  // namespace lagomorph::apps
