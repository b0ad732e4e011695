#pragma once

#include <stdexcept>
#include <string>

/// Errors carry the exit status of the contract; main prints `lagomorph: error: <what>` on one line.
namespace lagomorph::apps {

enum class ExitStatus {
  done = 0,
  different = 1,      // a check found a difference
  wrong_input = 2,    // wrong usage or wrong input; nothing was written
  simulation = 3,     // the simulation could not go on
  machine = 4,        // disk full, no ffmpeg
  interrupted = 130,  // SIGINT
  terminated = 143,   // SIGTERM
};

struct Error : std::runtime_error {
  Error(ExitStatus s, const std::string& what) : std::runtime_error(what), status(s) {}
  ExitStatus status;
};

[[noreturn]] inline void wrong_input(const std::string& what) { throw Error(ExitStatus::wrong_input, what); }

}  // namespace lagomorph::apps
