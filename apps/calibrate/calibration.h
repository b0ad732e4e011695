#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/check/golden_file.h"
#include "apps/check/result.h"
#include "apps/cli/options.h"
#include "apps/progress/progress.h"

/// Limits for a golden, found by trying: what does no harm on one side, known faults on the other.
namespace lagomorph::apps {

/// A picture that is drawn or changed on purpose, held against the run's own of the frame.
struct CalibrationCase {
  std::string name;  // "seed 3", "gamma 1.1"
  bool harmless = false;
  FrameResult result;  // frame, figures and bias
};

struct CalibrationRequest {
  std::filesystem::path run;
  std::filesystem::path golden;      // whose body ids masks may mean
  std::optional<FrameRange> frames;  // none: the first, the middle and the last
  int threads = 1;
};

/// Draws the frames again from RUN's states: with one thread and several, by the path tracer with other
/// seeds, by the rasterizer with another anti-aliasing; a step of 1 in 255 as another machine's rounding.
/// The faults: moved by a pixel, a cast, gamma 1.1, and of the body that is nearest to the camera a cluster
/// of triangles removed and one moved. Masks of the golden apply. Throws Error(wrong_input) when RUN has no
/// such states or no body is in the picture.
std::vector<CalibrationCase> calibration_cases(const CalibrationRequest&, const GoldenFile&, Progress&);

/// A limit between the two, and what it lies between.
struct ProposedLimit {
  LimitName name{};
  std::optional<double> value;  // none: "off", as harmless ones would fail by the preset's
  std::string why;
};

struct Proposal {
  std::vector<ProposedLimit> limits;  // over the preset `render`
  std::vector<std::string> no_room;   // faults that nothing tells from what is harmless; empty: all is well
};

/// The figures that limits are proposed for, in the order in which they are preferred.
struct CalibratedFigure {
  LimitName name;
  double (*value)(const FrameResult&);
};
const std::vector<CalibratedFigure>& calibrated_figures();

/// As few limits as tell every fault from all that is harmless, and one on the figure that is preferred, each
/// at the geometric mean of the largest harmless figure and the least of the faults that it tells, these
/// being 1.5 times apart at least.
Proposal propose_limits(const std::vector<CalibrationCase>&);

/// golden.toml with the proposal; what else `before` (an earlier golden.toml, or "") says stays, its comments
/// do not.
std::string proposal_toml(const Proposal&, const std::vector<CalibrationCase>&, const std::string& before);

}  // namespace lagomorph::apps
