#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/options.h"
#include "render/image_compare/bias.h"
#include "render/image_compare/compare.h"
#include "render/image_compare/light_noise.h"

/// What a check found, as plain values. Every report (report.json, junit.xml, report.html, the job summary)
/// is written from these alone.
namespace lagomorph::apps {

/// A rule that is broken: what was found, what is allowed, and who says so.
struct CheckFailure {
  /// "missing", "extra", "unreadable", "size", "bit_depth", "channels", "mask", "hash", "statistics", or the
  /// name of a limit: "flip_tile_max", "flip_mean", "max_abs", "flicker_tile_max", ...
  std::string rule;
  std::string found;  // "0.2222 at 192,96 (16x16 pixels)"
  std::string limit;  // "0.12"; empty where there is no number to keep
  std::string from;   // "golden.toml:4:17", "preset render (the default)"; empty with no limit
  /// "flip_tile_max 0.2222 at 192,96 (16x16 pixels), limit 0.12 by golden.toml:4:17"
  std::string line() const;
};

/// A limit that applies, for telling.
struct LimitTold {
  std::string name;
  double value = 0;
  bool least = false;  // true: figures must be at least this (psnr, ssim)
  std::string from;
};

/// What it took to decide on a frame.
enum class DecidedBy {
  nothing,  // there is no pair, or it cannot be compared
  bytes,    // the files are equal
  hash,     // the golden is a hash
  pixels,   // the decoded samples are equal
  metrics,  // the figures
};
/// "bytes", ...
std::string decided_by_name(DecidedBy);

/// A frame of RUN against the golden's of the same number.
struct FrameResult {
  int frame = 0;
  std::filesystem::path golden;  // picture that it was held against; empty: missing there, or only a hash
  std::filesystem::path fresh;   // RUN's picture; empty: missing
  std::string fresh_sha256;      // of RUN's file; empty: not read
  std::string variant;           // whose golden picture it was; empty: the golden's own
  DecidedBy decided_by = DecidedBy::nothing;
  std::vector<CheckFailure> failures;
  std::optional<render::Figures> figures;   // none where nothing could be compared
  std::optional<render::BiasFigures> bias;  // likewise
  /// The largest change of a tile's bias since the frame before: what flickers or pops. None for the first.
  std::optional<render::TileMean> flicker;
  std::optional<double> flicker_mean;  // the same of the whole picture
  /// The statistical test of path-traced light; none where no mc limit asks for it, or statistics are
  /// missing.
  std::optional<render::LightFigures> light;
  std::string no_light;            // why not, where one asks: "the golden has no tile_statistics"
  double masked = 0;               // share of the pixels that masks leave out, in [0, 1]
  std::vector<std::string> hints;  // "shifted by 1 pixel to the right", "is the golden's frame 13"
  std::string heat;                // picture of FLIP's errors, relative to CheckResult::out; empty: none
  std::string panel;               // golden | new | heat in one picture, likewise
  double seconds = 0;

  bool passed() const { return failures.empty(); }
};

/// Something seen only over several frames.
struct SequenceFinding {
  std::string kind;  // "time_shift", "pixel_shift", ...
  FrameRange frames;
  std::string text;  // "matches the golden's frame + 1 from 12 to 49"
};

struct SequenceResult {
  std::vector<FrameRange> bad;  // runs of failing frames, ascending
  std::vector<SequenceFinding> findings;
};

/// What of the run differs from the golden's before any pixel, the first being nearest to the cause.
struct Cause {
  std::string kind;  // "scene", "build", "machine", "simulation", "renderer"
  std::string text;  // one line
};

struct CheckResult {
  std::filesystem::path run;        // as given
  std::filesystem::path golden;     // as given
  std::filesystem::path out;        // folder of the reports
  std::string name;                 // of the golden: the reports' suite
  std::string preset;               // that applies where nothing else is said
  std::vector<LimitTold> limits;    // that apply to all frames
  double pixels_per_degree = 0;     // FLIP's
  std::vector<FrameResult> frames;  // ascending
  SequenceResult sequence;
  std::vector<Cause> causes;
  std::vector<std::string> remarks;  // what is not as it should be, and no failure
  double seconds = 0;

  int failed() const;  // frames
  bool passed() const { return failed() == 0; }
};

/// The failing frames, the one that differs most first: what is missing or not comparable, then by the
/// largest mean of a tile.
std::vector<const FrameResult*> worst_first(const CheckResult&);

/// Shell commands that a report shows beside a failing frame.
struct FrameCommands {
  std::string reproduce;  // lagomorph check RUN GOLDEN --frames 12
  std::string rerender;   // lagomorph render RUN --frames 12 --force
  std::string approve;    // lagomorph approve RUN GOLDEN --frames 12
};
FrameCommands frame_commands(const CheckResult&, int frame);

}  // namespace lagomorph::apps
