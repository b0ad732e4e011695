#include "apps/cli/print.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "apps/error.h"

namespace lagomorph::apps {

void print(std::string_view text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) return;
  throw Error(ExitStatus::machine, std::string("standard output cannot be written: ") + std::strerror(errno));
}

}  // namespace lagomorph::apps
