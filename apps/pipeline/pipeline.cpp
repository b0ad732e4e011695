#include "apps/pipeline/pipeline.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <semaphore>
#include <utility>

#include "apps/pipeline/bounded_queue.h"
#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/frame_writer.h"
#include "apps/pipeline/motion.h"
#include "apps/pipeline/state_source.h"
#include "apps/pipeline/stop.h"
#include "apps/pipeline/stopwatch.h"
#include "apps/pipeline/workers.h"
#include "sim/profile.h"

namespace lagomorph::apps {
namespace {

constexpr std::size_t frames_between_stages = 2;  // bounds the memory
constexpr int most_writers = 2;                   // encoding is quicker than drawing

/// Lets no more stages be at work at once than there are threads.
class Turns {
public:
  explicit Turns(int threads) : free_(threads) {}
  auto take(const auto& work) {
    free_.acquire();
    struct Release {
      std::counting_semaphore<>& free;
      ~Release() { free.release(); }
    } const release{free_};
    return work();
  }

private:
  std::counting_semaphore<> free_;
};

template <class T>
std::optional<T> next_of(BoundedQueue<T>& queue, sim::Stage waiting) {
  const sim::Timed timed(waiting);
  return queue.pop();
}

DrawnFrame draw(const PipelineInput& in, StateFrame frame) {
  DrawnFrame drawn{.of = std::move(frame), .image = {}, .seconds = 0.0};
  if (!drawn.of.job.draw || stop_asked()) return drawn;  // a stopped run still keeps the state
  const Stopwatch watch;
  std::optional<Motion> motion;
  if (drawn.of.before) {
    const double shutter =
        in.renderer->draws_motion_blur() ? static_cast<double>(in.scene.camera.shutter) : 0.0;
    motion = motion_between(*drawn.of.before, drawn.of.state, 1.0 / in.scene.time.fps, shutter);
    drawn.of.before.reset();
  }
  const sim::VecX& q = drawn.of.state.q;
  {
    const sim::Timed timed(sim::Stage::surface);
    move_meshes(*in.renderer, in.surfaces, q, motion ? &*motion : nullptr);
  }
  const double read_before = in.renderer->seconds_reading_back();
  const Stopwatch drawing;
  drawn.image =
      in.views.draw(*in.renderer, {drawn.of.job.frame, drawn.of.state.t}, q, motion ? &*motion : nullptr);
  const auto add = [](sim::Stage stage, double seconds) {
    sim::profile().add(stage, std::chrono::nanoseconds(std::llround(1e9 * seconds)));
  };
  const double reading = in.renderer->seconds_reading_back() - read_before;
  add(sim::Stage::draw, drawing.seconds() - reading);
  if (reading > 0.0) add(sim::Stage::read_back, reading);
  drawn.seconds = watch.seconds();
  return drawn;
}

}  // namespace

PipelineResult run_pipeline(const PipelineInput& in, Progress& progress) {
  StateSource states(in.scene, in.model, in.integrator, in.paths, in.log_newton);
  const FrameWriter writer(in.paths, in.identity, in.scene, in.records, in.views, in.renderer != nullptr);
  BoundedQueue<StateFrame> to_draw(frames_between_stages);
  BoundedQueue<DrawnFrame> to_write(frames_between_stages);
  Turns turns(in.threads);
  std::atomic<int> frames_done = 0, states_made = 0, pictures_made = 0;
  Workers workers([&] {
    to_draw.abandon();
    to_write.abandon();
  });
  progress.begin(static_cast<int>(in.jobs.size()), 1, in.stage);

  workers.start([&] {  // 1. In order, each frame's state is read or stepped from the one before,
    for (const FrameJob& job : in.jobs) {
      if (stop_asked()) break;
      std::optional<StateFrame> frame = turns.take([&] { return states.next(job); });
      if (!frame) break;
      const sim::Timed timed(sim::Stage::wait_to_simulate);
      if (!to_draw.push(std::move(*frame))) break;
    }
    to_draw.close();
  });
  for (int i = 0; i < std::clamp(in.threads - 1, 1, most_writers); ++i) {
    workers.start([&] {  // 3. and it is written, with its record, while the next ones are on their way.
      while (const std::optional<DrawnFrame> frame = next_of(to_write, sim::Stage::wait_to_write)) {
        std::optional<FrameWriter::Written> written = turns.take([&] { return writer.write(*frame); });
        frames_done += frame->of.job.draw && !frame->image ? 0 : 1;
        states_made += frame->of.made ? 1 : 0;
        pictures_made += frame->image ? 1 : 0;
        if (written && in.picture_written)
          in.picture_written(frame->of.job.frame, std::move(written->picture), written->sha256);
        progress.frame_done();
      }
    });
  }
  workers.guard([&] {  // 2. the renderer draws it in the thread that made it,
    while (std::optional<StateFrame> frame = next_of(to_draw, sim::Stage::wait_to_draw)) {
      if (!to_write.push(turns.take([&] { return draw(in, std::move(*frame)); }))) break;
    }
    to_write.close();
  });
  const std::exception_ptr error = workers.finish();
  progress.end();
  return {frames_done, states_made, pictures_made, states.failure(), error, false};
}

}  // namespace lagomorph::apps
