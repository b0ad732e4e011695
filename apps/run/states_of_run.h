#pragma once

#include <map>

#include "apps/cli/options.h"
#include "apps/run/identity.h"
#include "apps/run/paths.h"
#include "apps/run/record.h"

namespace lagomorph::apps {

/// The states that a run holds for others to draw.
class StatesOfRun {
public:
  /// Those of frames 0..frame_count-1 that are the run's own. Throws Error(wrong_input) when there is none.
  StatesOfRun(const RunPaths&, const Identity& of_run, int frame_count);

  const std::map<int, StateRecord>& records() const { return records_; }
  /// From the first one on as far as there is no gap.
  FrameRange all() const;
  /// Throws Error(wrong_input) when a state of these frames is not there with the bytes that its record
  /// tells.
  void require(FrameRange) const;
  /// Gives RUN those that it has not: another name of the same file where the file system can, a copy
  /// otherwise. `records` are RUN's; they tell of these states afterwards.
  void bring_to(const RunPaths& run, std::map<int, FrameRecord>& records) const;

private:
  RunPaths paths_;
  std::map<int, StateRecord> records_;
};

}  // namespace lagomorph::apps
