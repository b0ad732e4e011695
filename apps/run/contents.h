#pragma once

#include <map>
#include <optional>

#include "apps/run/identity.h"
#include "apps/run/paths.h"
#include "apps/run/record.h"
#include "apps/run/run_json.h"

namespace lagomorph::apps {

/// What a run's folder holds, seen by who wants a run of some identity.
struct RunContents {
  std::optional<RunInfo> info;          // run.json; nullopt when there is none
  std::map<int, FrameRecord> on_disk;   // every record
  std::map<int, FrameRecord> matching;  // only those parts of them that are of the wanted identity
  int other_states = 0;                 // how many are not
  int other_pictures = 0;
};

/// Reads the folder; it need not exist. Throws Error(wrong_input) when it holds what is no run.
RunContents read_contents(const RunPaths&, const Identity& wanted);

/// The parts of a record that are of the wanted identity.
FrameRecord matching_parts(const FrameRecord&, const Identity& wanted);

/// Throws Error(wrong_input) that names the differing keys when the folder holds states or pictures of
/// another identity. What only a killed --force left is no reason.
void refuse_others(const RunPaths&, const RunContents&, const Identity& wanted);

/// Removes states and pictures that do not match or have no record, and temporary files of killed processes.
void remove_unmatched(const RunPaths&, const RunContents&);

}  // namespace lagomorph::apps
