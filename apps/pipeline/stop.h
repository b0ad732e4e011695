#pragma once

#include "apps/error.h"

namespace lagomorph::apps {

/// While it lives, the first SIGINT or SIGTERM only asks to stop; a second one ends the process at once. A
/// file that is too large for the process's limit is an error of the write and no signal.
class StopSignals {
public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
};

/// Whether one came.
bool stop_asked();
/// interrupted or terminated, by the signal that came.
ExitStatus stop_status();

}  // namespace lagomorph::apps
