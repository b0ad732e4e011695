#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/options.h"
#include "apps/run/paths.h"
#include "apps/run/plan.h"
#include "apps/run/record.h"
#include "apps/run/run_json.h"
#include "apps/run/video_ahead.h"
#include "apps/scene/scene_desc.h"

namespace lagomorph::apps {

struct VideoUpdate {
  VideoRecord record;
  bool made = false;     // false: it was up to date
  std::string replaced;  // file that went; empty: none
};

/// Encodes the video of a run, all of whose `frames` will have pictures, while these are made; see
/// VideoAhead. `records`: those that are there, of which `jobs` make some anew.
std::unique_ptr<VideoAhead> begin_video(const RunPaths&, const SceneDesc&,
                                        const std::map<int, FrameRecord>& records,
                                        const std::vector<FrameJob>& jobs, FrameRange frames,
                                        const std::string& codec);

/// Brings RUN/<name> with the codec's extension up to date: of all pictures around `frames` that have no gap
/// between them, so that a run in shards ends with the video of the whole. Left alone when it is that
/// already; `ahead`, or nullptr, may have it. Returns what run.json tells of it; nullopt when `stop` ended
/// it. Throws Error(machine), with the command to run later, when ffmpeg cannot.
std::optional<VideoUpdate> update_video(const RunPaths&, const SceneDesc&,
                                        const std::map<int, FrameRecord>& records, FrameRange frames,
                                        const std::string& codec, const std::optional<VideoRecord>& there,
                                        VideoAhead* ahead, const std::function<bool()>& stop);

}  // namespace lagomorph::apps
