#include "apps/pipeline/stop.h"

#include <atomic>
#include <csignal>
#include <initializer_list>

namespace lagomorph::apps {
namespace {

std::atomic<int> came = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // as a signal handler needs

void remember(int signal) { came = signal; }

}  // namespace

StopSignals::StopSignals() {
  came = 0;
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second one finds the default: the end
  sigemptyset(&action.sa_mask);
  // Also where a shell's script started us in the background, which ignores SIGINT: who sends it means it.
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

StopSignals::~StopSignals() {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction now;
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == remember) std::signal(signal, SIG_DFL);
  }
}

bool stop_asked() { return came != 0; }
ExitStatus stop_status() { return came == SIGTERM ? ExitStatus::terminated : ExitStatus::interrupted; }

}  // namespace lagomorph::apps
