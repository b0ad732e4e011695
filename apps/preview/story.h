#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/preview/material.h"
#include "apps/preview/shown.h"

namespace lagomorph::apps {

/// "bunny: 150 frames, 5.0 s at 30 fps, all steps converged".
std::string headline(const PreviewMaterial&);

/// What else is worth a line each: a label and its value, as plain text.
using Facts = std::vector<std::pair<std::string, std::string>>;
/// Of the run: frames, size, energies, steps, seconds.
Facts run_facts(const PreviewMaterial&, const Shown&);
/// Of program, libraries and machine; none without run.json.
Facts environment_facts(const PreviewMaterial&);

/// The time of a frame [s].
double frame_time(const PreviewMaterial&, int frame);

/// Seconds that a frame took on average, over those that were made.
struct FrameSeconds {
  double simulation = 0, rendering = 0, writing = 0;
  double total() const { return simulation + rendering + writing; }
};
FrameSeconds mean_frame_seconds(const PreviewMaterial&);

}  // namespace lagomorph::apps
