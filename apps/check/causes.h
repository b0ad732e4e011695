#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/check/result.h"
#include "apps/check/run_story.h"

namespace lagomorph::apps {

/// Walks back up the pipeline from frames that fail: what of the run differs from the run that became the
/// golden, the scene first, then the build and the machine, the simulation, the renderer.
std::vector<Cause> find_causes(const RunStory& run, const RunStory& golden,
                               const std::vector<FrameResult>& frames);

/// The last two of these.
/// "simulation": the first frame whose state differs, the vertex that moved most where both keep the state,
/// the frame whose energies part most.
std::optional<Cause> simulation_cause(const RunStory& run, const RunStory& golden);
/// "renderer": failing frames that show states which are the golden's to the bit.
std::optional<Cause> renderer_cause(const RunStory& run, const RunStory& golden,
                                    const std::vector<FrameResult>& frames);

}  // namespace lagomorph::apps
