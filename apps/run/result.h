#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "apps/run/record.h"

namespace lagomorph::apps {

/// What a command did, for `--json` and for the last line on stderr.
struct RunResult {
  std::filesystem::path run;
  std::string status = "done";  // or "failed", "interrupted"
  std::string reason;           // why, when not done
  bool begun = false;           // something may have been written
  int frames = 0;               // asked for
  int states_made = 0;          // of them, this time
  int pictures_made = 0;
  double seconds = 0.0;                // all of it
  std::map<int, FrameRecord> records;  // of the whole run
  std::string video;                   // file in the run; empty: none
  bool video_made = false;             // this time
  std::string video_replaced;          // file that it took the place of; empty: none
};

/// One JSON object on one line.
std::string result_json(const RunResult&);
/// "out/bunny: 150 frames in 16 s, ...", or that there was nothing to do.
std::string result_text(const RunResult&);

}  // namespace lagomorph::apps
