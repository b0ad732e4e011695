#include "apps/pipeline/state_source.h"

#include <filesystem>
#include <optional>
#include <vector>

#include "apps/file_io.h"
#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/stopwatch.h"
#include "apps/run/record.h"
#include "apps/run/state_file.h"
#include "sim/profile.h"

namespace lagomorph::apps {

StateSource::StateSource(const SceneDesc& scene, const sim::Model& model, sim::Integrator& integrator,
                         const RunPaths& paths, bool log_newton)
    : scene_(scene), model_(model), integrator_(integrator), paths_(paths), log_newton_(log_newton) {}

sim::State StateSource::read(int frame) const {
  const std::optional<FrameRecord> record = read_record(paths_, frame);
  const std::vector<double> times =
      record && record->state ? record->state->history_times : std::vector<double>();
  return read_state(paths_.state(frame), frame, scene_.time.fps, model_.mesh().vertex_count(), times);
}

bool StateSource::simulate(int frame, sim::State& state, StateRecord& record) {
  const sim::Timed timed(sim::Stage::simulation);
  const Stopwatch watch;
  if (frame == 0) {
    state = integrator_.initial_state(model_);
  } else {
    const bool at_hand = last_ && last_->frame == frame - 1;
    state = at_hand ? std::move(*last_) : read(frame - 1);
    record.report = sim::advance_frame(model_, integrator_, scene_.time, scene_.solver, state);
    if (!sim::is_good(record.report.status)) {
      failure_ = record.report.reason;
      return false;
    }
  }
  if (!log_newton_) record.report.newton.clear();
  record.time = state.t;
  for (const sim::State::Level& level : state.history) record.history_times.push_back(level.t);
  record.energy = model_.energies_of(state);
  record.mass = model_.total_mass();
  record.momentum = model_.momentum(state);
  record.angular_momentum = model_.angular_momentum(state);
  record.min_J = model_.min_J(state.q);
  record.seconds = watch.seconds();
  return true;
}

std::optional<StateFrame> StateSource::next(const FrameJob& job) {
  StateFrame frame{.job = job, .state = {}, .before = {}, .made = {}};
  if (job.draw && job.frame > 0 && draws_motion(scene_)) {
    const bool at_hand = last_ && last_->frame == job.frame - 1;
    if (!at_hand) last_ = read(job.frame - 1);
    frame.before = {.t = last_->t, .q = last_->q, .qdot = last_->qdot};
  }
  if (!job.simulate) {
    frame.state = read(job.frame);
  } else if (!simulate(job.frame, frame.state, frame.made.emplace())) {
    return std::nullopt;
  }
  last_ = frame.state;
  return frame;
}

}  // namespace lagomorph::apps
