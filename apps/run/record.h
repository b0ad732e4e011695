#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "apps/run/paths.h"
#include "sim/integrator.h"
#include "sim/model.h"

namespace lagomorph::apps {

/// A state on disk, and what is told of it.
struct StateRecord {
  std::string sha256;                 // of the file
  std::string made_by;                // Identity::state of the run that made it
  double time = 0.0;                  // [s]
  std::vector<double> history_times;  // of its levels before this one, newest first [s]
  sim::Energies energy;
  double mass = 0.0;                               // [kg]
  sim::Vec3 momentum = sim::Vec3::Zero();          // [kg m/s]
  sim::Vec3 angular_momentum = sim::Vec3::Zero();  // about the origin [kg m^2/s]
  double min_J = 1.0;                              // least det F of all elements
  sim::FrameReport report;                         // of the steps that led here; none for frame 0
  double seconds = 0.0;                            // spent in simulation
};

/// A picture on disk, and the other channels beside it.
struct PictureRecord {
  std::string sha256;
  std::string made_by;                                  // Identity::picture of the run that drew it
  std::string of_state;                                 // sha256 of the state that it shows
  std::map<std::string, std::string> channels;          // sha256 by channel_files()
  std::map<std::string, std::array<double, 2>> ranges;  // of the field shown on a body, by its name
  std::optional<std::array<double, 6>> fitted_box;      // of all frames, that the camera is fitted to [m]
  double clamp = 0.0;  // render.path.clamp where it cut indirect light; 0: nothing did
  double rendering_seconds = 0.0;
  double writing_seconds = 0.0;  // tone curve, encoding, files
};

/// What is known of a frame: written after its state and its picture. A frame without one is made again.
struct FrameRecord {
  int frame = 0;
  std::optional<StateRecord> state;
  std::optional<PictureRecord> picture;
};

nlohmann::ordered_json to_json(const FrameRecord&);
void write_record(const RunPaths&, const FrameRecord&);

/// One frame's record; nothing when there is none that can be read.
std::optional<FrameRecord> read_record(const RunPaths&, int frame);

/// Every record that can be read, by frame. What is no record of ours is left out: its frame is made again.
std::map<int, FrameRecord> read_records(const RunPaths&);

/// What run.json tells of the frames: the records that were there when it was written. None when it cannot be
/// read.
std::map<int, FrameRecord> read_gathered_records(const RunPaths&);

}  // namespace lagomorph::apps
