#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/options.h"
#include "apps/progress/progress.h"

namespace lagomorph::apps {

/// What is to become golden.
struct ApproveRequest {
  std::filesystem::path run;
  std::filesystem::path golden;
  std::optional<FrameRange> frames;             // only these
  std::optional<std::filesystem::path> report;  // report.json: only the frames that failed there
  std::optional<std::string> variant;           // into the golden's variant of this name
  bool passing_too = false;                     // also frames that pass already
  std::optional<int> states_every;              // for the first golden.toml
};

/// A frame whose golden is made or renewed.
struct AcceptedFrame {
  int frame = 0;
  std::filesystem::path from;        // RUN's picture
  std::filesystem::path to;          // the golden's
  std::filesystem::path state;       // RUN's state, to be kept too; empty: it is not
  bool only_hash = false;            // the picture itself is not kept
  bool is_new = false;               // there was no golden
  std::vector<std::string> changes;  // the rules that its golden broke, and what it looks like
};

struct Approval {
  std::vector<AcceptedFrame> accepted;  // ascending
  std::vector<int> untouched;           // they pass
  std::vector<int> missing;             // asked for by the report, and RUN has no picture of them
};

/// Finds what is to be done, checking the run as `check` does; nothing is written. Throws Error(wrong_input)
/// when RUN has no such pictures, one of them is no whole PNG, or is another than the report judged.
Approval plan_approval(const ApproveRequest&, Progress&);

/// Does it: pictures, hashes.json, golden.toml where there is none, run.json, states. Each file whole or not
/// at all.
void carry_out(const ApproveRequest&, const Approval&);

}  // namespace lagomorph::apps
