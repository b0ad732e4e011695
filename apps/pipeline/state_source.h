#pragma once

#include <optional>
#include <string>

#include "apps/pipeline/frames.h"
#include "apps/run/paths.h"
#include "apps/scene/scene_desc.h"
#include "sim/integrator.h"
#include "sim/model.h"

namespace lagomorph::apps {

/// Gives the states of a run, frame by frame: those on disk as they are, the others by stepping.
class StateSource {
public:
  StateSource(const SceneDesc&, const sim::Model&, sim::Integrator&, const RunPaths&, bool log_newton);

  /// The state of a job's frame, and what the one before it was where the picture tells of motion.
  /// The one before it must have been given, or be on disk. nullopt when the simulation cannot go on;
  /// failure() says why. Throws Error(wrong_input) for a file that is no state of this model.
  std::optional<StateFrame> next(const FrameJob&);
  const std::string& failure() const { return failure_; }

private:
  sim::State read(int frame) const;
  /// False when the simulation cannot go on.
  bool simulate(int frame, sim::State&, StateRecord&);

  const SceneDesc& scene_;
  const sim::Model& model_;
  sim::Integrator& integrator_;
  const RunPaths& paths_;
  bool log_newton_;
  std::optional<sim::State> last_;
  std::string failure_;
};

}  // namespace lagomorph::apps
