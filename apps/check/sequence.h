#pragma once

#include <map>
#include <vector>

#include "apps/check/golden_file.h"
#include "apps/check/probe.h"
#include "apps/check/result.h"
#include "render/image_compare/bias.h"

namespace lagomorph::apps {

/// Fills in how each frame's differences changed since the frame before, and fails frames that flicker though
/// both would pass. `biases` are of frames that could be compared.
void judge_flicker(std::vector<FrameResult>& frames, const std::map<int, render::TileBias>& biases,
                   const GoldenFile&);

/// Runs of failing frames, and what their probes have in common.
SequenceResult analyse_sequence(const std::vector<FrameResult>& frames, const std::map<int, Probe>& probes);

}  // namespace lagomorph::apps
