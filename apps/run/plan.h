#pragma once

#include <map>
#include <optional>
#include <vector>

#include "apps/cli/options.h"
#include "apps/run/paths.h"
#include "apps/run/record.h"

namespace lagomorph::apps {

/// What is to be made of a frame.
struct FrameJob {
  int frame = 0;
  bool simulate = false;  // its state is not there
  bool draw = false;      // its picture is wanted and not there
};

/// What of frames 0..last (states) and drawn (pictures) is not there with the bytes that its record tells, in
/// order. Without `drawn` nothing is drawn.
std::vector<FrameJob> missing_frames(const RunPaths&, const std::map<int, FrameRecord>& matching, int last,
                                     std::optional<FrameRange> drawn);

/// Whether a frame's picture and channels are there with the bytes that the record tells.
bool picture_is_there(const RunPaths&, const FrameRecord&);

/// `--frames`, or all of them. Throws Error(wrong_input) for frames that the scene has not.
FrameRange wanted_frames(const std::optional<FrameRange>& asked, int frame_count);

}  // namespace lagomorph::apps
