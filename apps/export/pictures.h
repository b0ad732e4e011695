#pragma once

#include <string>

#include "apps/cli/options.h"
#include "apps/error.h"

namespace lagomorph::apps {

/// A picture's name by a pattern in which the last run of # stands for the frame's number with at least so
/// many digits: shot.####.png. Throws Error(wrong_input) for a pattern without one, or that is no plain name
/// of a .png.
std::string picture_name(const std::string& pattern, int frame);

/// Copies a run's pictures to names by `--pattern`, <scene name>.####.png without one. RUN keeps its own:
/// what is done to the copies does not touch it. Throws Error(wrong_input) for a picture that is not there.
ExitStatus export_pictures(const Options&);

}  // namespace lagomorph::apps
