#pragma once

#include <map>
#include <string>

#include "apps/run/record.h"

namespace lagomorph::apps {

/// newton.csv: a row for each point that Newton's method came to, of the frames that logged it; 17 digits.
/// `time` is where the step begins and `h` its length [s], `status` how it ended, `residual` |g_free| over
/// its reference, `energy` the potential that is minimized [J], `step` the part of Newton's step that was
/// taken, `clamping` 0 for the exact Hessian, 1 for the projected one. Empty when no frame did.
std::string newton_csv(const std::map<int, FrameRecord>& frames);

}  // namespace lagomorph::apps
