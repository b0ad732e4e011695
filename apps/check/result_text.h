#pragma once

#include <string>

#include "apps/check/result.h"

namespace lagomorph::apps {

/// What `check` prints for people: what is to blame, the verdict, the worst frames with every rule they
/// break, runs of bad frames, remarks, where the reports are.
std::string check_text(const CheckResult&);

/// "2 of 9 frames differ; the same are 7 by bytes".
std::string verdict_text(const CheckResult&);

}  // namespace lagomorph::apps
