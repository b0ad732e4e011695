#pragma once

#include <span>
#include <string>

#include "apps/cli/options.h"
#include "apps/error.h"

namespace lagomorph::apps {

/// What a command line asks for: a text to print (help, version), or a command to run with its options.
struct CommandLine {
  std::string text;  // to stdout; when not empty there is nothing else to do
  ExitStatus (*command)(const Options&) = nullptr;
  Options options = {};
};

/// `arguments` without the program's name. Throws Error(wrong_input) with one line.
CommandLine parse_command_line(std::span<const std::string> arguments);

/// What `lagomorph --help` prints.
std::string program_help();

/// "A..B" or "N" as an inclusive range of frames. Throws Error(wrong_input) that begins with `what` and the
/// text.
FrameRange parse_frames(const std::string& text, const std::string& what = "--frames ");

}  // namespace lagomorph::apps
