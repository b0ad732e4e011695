#pragma once

#include <exception>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "apps/pipeline/frames.h"
#include "apps/pipeline/views.h"
#include "apps/progress/progress.h"
#include "apps/run/identity.h"
#include "apps/run/paths.h"
#include "apps/scene/scene_desc.h"
#include "render/renderer.h"
#include "sim/integrator.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// What a run is made from, and where to.
struct PipelineInput {
  const SceneDesc& scene;
  const sim::Model& model;
  const std::vector<sim::Surface>& surfaces;
  const Views& views;
  sim::Integrator& integrator;
  render::Renderer*
      renderer;  // with its scene set; made by the calling thread; nullptr when nothing is drawn
  const RunPaths& paths;
  const Identity& identity;
  const std::map<int, FrameRecord>& records;  // of frames that are there
  const std::vector<FrameJob>& jobs;          // in order
  int threads;                                // stages at work at once, and writers
  bool log_newton;                            // into the records
  std::string stage;                          // see Progress::begin()
  /// From any thread, when the frame's record is there.
  std::function<void(int frame, render::Picture, const std::string& sha256)> picture_written = {};
};

struct PipelineResult {
  int frames = 0;            // of the jobs, done
  int states = 0;            // simulated and written
  int pictures = 0;          // drawn and written
  std::string failure;       // why the simulation could not go on; empty otherwise
  std::exception_ptr error;  // what a stage threw; none otherwise
  bool stopped = false;      // before it was known what there is to draw
};

/// Makes the frames of the jobs. The simulation of the next frames overlaps drawing and writing of this one.
/// Ends early, with every record whole, when a stage fails, the simulation cannot go on or stop_asked().
PipelineResult run_pipeline(const PipelineInput&, Progress&);

}  // namespace lagomorph::apps
