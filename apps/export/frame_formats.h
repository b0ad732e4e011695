#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/fields.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// What every frame of an export has in common.
struct ExportedScene {
  const sim::Model& model;
  std::vector<sim::Surface> surfaces;  // what is drawn of each body
  std::vector<std::string> fields;     // names in sim::field_table()
};

/// A file format for a frame: tets with fields, or the drawn surfaces of all bodies.
struct FrameFormat {
  const char* name;   // its extension, without the dot
  bool takes_fields;  // scalars of vertices, of tets in vtu
  bool all_fields;    // when none is asked for
  std::string (*bytes)(const ExportedScene&, const sim::State&);
};

/// Throws Error(wrong_input) that lists the formats for a name that is none.
const FrameFormat& find_format(std::string_view name);

}  // namespace lagomorph::apps
