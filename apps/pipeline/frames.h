#pragma once

#include <optional>

#include "apps/run/plan.h"
#include "apps/run/record.h"
#include "render/image.h"
#include "sim/model.h"

/// A frame on its way from the simulation to the disk.
namespace lagomorph::apps {

struct StateFrame {
  FrameJob job;
  sim::State state;
  std::optional<sim::State::Level> before;  // the frame before, when the picture tells of motion
  std::optional<StateRecord> made;          // when it was simulated: what is told of it, without its hash
};

struct DrawnFrame {
  StateFrame of;
  std::optional<render::Image> image;  // when it was drawn
  double seconds = 0.0;                // spent in drawing it
};

}  // namespace lagomorph::apps
