#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "apps/cli/command_line.h"
#include "apps/cli/print.h"
#include "apps/one_line.h"
#include "apps/run/blas_kernel.h"
#include "render/error.h"
#include "sim/error.h"

namespace {

using lagomorph::apps::ExitStatus;

int fail(ExitStatus status, std::string_view what) {
  constexpr std::size_t longest = 4000;  // bytes; a file may hold a name of any length
  std::fprintf(stderr, "lagomorph: error: %s\n", lagomorph::apps::one_line(what.substr(0, longest)).c_str());
  return static_cast<int>(status);
}

int lagomorph_main(const std::vector<std::string>& arguments) {
  if (arguments.empty()) lagomorph::apps::print(lagomorph::apps::program_help());
  const lagomorph::apps::CommandLine line = lagomorph::apps::parse_command_line(arguments);
  const ExitStatus status = line.text.empty() ? line.command(line.options) : ExitStatus::done;
  lagomorph::apps::print(line.text);  // and what a command left in the buffer, where a failure can be told
  return static_cast<int>(status);
}

}  // namespace

int main(int argc, char** argv) {
  lagomorph::apps::restart_with_better_blas_kernel(argv);
  std::signal(SIGPIPE, SIG_IGN);  // a pipe that closed is an error of the write, told like any other
  try {
    return lagomorph_main({argv + (argc > 0 ? 1 : 0), argv + argc});
  } catch (const lagomorph::apps::Error& e) {
    return fail(e.status, e.what());
  } catch (const lagomorph::sim::InputError& e) {
    return fail(ExitStatus::wrong_input, e.what());
  } catch (const lagomorph::render::SettingsError& e) {
    return fail(ExitStatus::wrong_input, e.what());
  } catch (const lagomorph::render::DeviceError& e) {
    return fail(ExitStatus::machine, e.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::machine, "out of memory");
  } catch (const std::exception& e) {
    return fail(ExitStatus::machine, e.what());
  } catch (...) {
    return fail(ExitStatus::machine, "unknown failure");
  }
}
