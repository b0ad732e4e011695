#pragma once

#include <map>

#include "apps/run/paths.h"
#include "apps/run/record.h"
#include "apps/run/run_json.h"

namespace lagomorph::apps {

/// Writes run.json, energy.csv and, where iterations were logged, newton.csv of the records that are there,
/// match, and are of frames 0..frame_count-1. Files that would not change are left alone. Returns those
/// records.
std::map<int, FrameRecord> gather(const RunPaths&, const RunInfo&, int frame_count);

}  // namespace lagomorph::apps
