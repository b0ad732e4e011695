#pragma once

#include "apps/cli/options.h"
#include "apps/error.h"

namespace lagomorph::apps {

/// Copies a run's pictures to names by `--pattern`, <scene name>.####.png without one. RUN keeps its own:
/// what is done to the copies does not touch it. Throws Error(wrong_input) for a picture that is not there.
ExitStatus export_pictures(const Options&);

}  // namespace lagomorph::apps
