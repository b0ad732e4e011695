#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/cli/options.h"
#include "apps/scene/scene_desc.h"
#include "render/camera.h"
#include "render/types.h"
#include "sim/fields.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// What every frame of an export has in common.
struct ExportedScene {
  const SceneDesc& desc;
  const sim::Model& model;
  std::vector<sim::Surface> surfaces;                                      // what is drawn of each body
  std::vector<std::string> fields;                                         // names in sim::field_table()
  render::CameraSettings camera;                                           // that of the first frame
  std::function<render::CameraSettings(const sim::State&)> moving_camera;  // none: it stands still
  /// Linear RGB of each body's vertices in one frame, by the field it shows; none of one that shows none.
  std::vector<std::vector<render::Color>> colors = {};
  int color_frame = 0;  // whose they are
};

/// A run of frames, whose states are read as they are asked for: one in memory at a time.
struct ExportedSequence {
  const ExportedScene& scene;
  FrameRange frames;
  std::function<sim::State(int frame)> state;
  std::function<bool()> stop;      // whether the export was asked to stop
  std::function<void()> told;      // a frame of a pass is done
  std::function<void(int)> begin;  // so many passes over the frames are to come

  int count() const { return frames.last - frames.first + 1; }
  /// Calls for each frame, in order. False: asked to stop.
  bool each(const std::function<void(const sim::State&)>& visit) const;
};

/// A file format for the tets with fields, or the drawn surfaces of all bodies: a file a frame, or one of the
/// whole sequence.
struct ExportFormat {
  const char* name;
  const char* extension;
  bool takes_fields;                                              // scalars of vertices, of tets in vtu
  bool all_fields;                                                // when none is asked for
  bool takes_colors;                                              // of vertices, as ExportedScene has them
  std::string (*frame)(const ExportedScene&, const sim::State&);  // the file of a frame, or null
  bool (*sequence)(const ExportedSequence&,
                   const std::filesystem::path& file);        // or that of all; false: stopped
  std::vector<std::string> (*remarks)(const ExportedScene&);  // what of the look it leaves out, or null
};

/// Throws Error(wrong_input) that lists the formats for a name that is none.
const ExportFormat& find_format(std::string_view name);

}  // namespace lagomorph::apps
