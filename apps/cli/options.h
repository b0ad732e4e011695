#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/settings.h"

namespace lagomorph::apps {

/// Inclusive range of frames, `--frames A..B` or `--frames N`.
struct FrameRange {
  int first = 0;
  int last = 0;
  int every = 1;  // only first, first + every, ...

  bool has(int frame) const { return frame >= first && frame <= last && (frame - first) % every == 0; }
  int count() const { return (last - first) / every + 1; }
};

/// The command line of every command: options have one meaning everywhere.
struct Options {
  std::string command;                          // run, simulate, render, info, ...
  std::vector<std::string> inputs;              // SCENE.toml, RUN, FILE, A and B as given
  std::optional<std::filesystem::path> out;     // -o, --out
  std::vector<std::string> set;                 // --set, in order
  std::optional<FrameRange> frames;             // --frames
  int every = 1;                                // --every
  bool half = false;                            // --half: drafts
  std::optional<std::vector<int>> region;       // --region: x0, y0, x1, y1
  std::optional<std::string> pattern;           // --pattern
  std::optional<std::string> backend;           // --backend
  int threads = 0;                              // --threads; 0: as many as the process may use
  bool video = false;                           // --video, --codec
  std::string codec = "h264";                   // --codec
  bool is_static = false;                       // --static: the equilibrium instead of the motion
  bool log_newton = false;                      // --log-newton
  bool profile = false;                         // --profile
  bool force = false;                           // --force
  bool quiet = false;                           // --quiet
  bool json = false;                            // --json
  std::optional<std::filesystem::path> mend;    // info --mend OUT: drop stray vertices
  std::optional<int> levels;                    // refine --levels
  std::optional<int> order;                     // refine --order
  bool keys = false;                            // info --keys: the table of scene keys
  std::optional<double> pixels_per_degree;      // compare, check --ppd
  std::optional<std::filesystem::path> heat;    // compare --heat FILE.png
  std::optional<int> states_every;              // approve --states
  std::optional<std::string> preset;            // check --preset
  std::optional<std::string> variant;           // check, approve --variant
  std::optional<std::filesystem::path> report;  // approve --report report.json
  bool prune = false;                           // approve --prune
  bool yes = false;                             // approve --prune --yes
  bool ctest = false;                           // check --ctest
  bool assets = false;                          // check --assets
  bool github = false;                          // check --github
  std::vector<std::string> columns;             // plot --columns; empty: all
  std::vector<std::string> fields;              // export --fields; empty: as the format has it
  std::optional<std::string> format;            // plot, export --format
  std::optional<int> color_frame;               // export --color-frame
  bool calibrate = false;                       // check --calibrate, with --yes into GOLDEN
  sim::MaterialSettings material;               // material --young ...; its model is the input
  std::optional<std::string> F;                 // material --F, nine numbers row by row
};

}  // namespace lagomorph::apps
