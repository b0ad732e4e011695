#pragma once

#include <string>

#include "apps/export/formats.h"

namespace lagomorph::apps {

/// Wavefront OBJ of one frame: an object a body with its material of obj_library(), and vertex normals where
/// it is drawn smooth.
std::string write_obj_frame(const ExportedScene&, const sim::State&);

/// The material library (.mtl) that the frames of a scene name; in the same folder.
std::string obj_library_name(const SceneDesc&);

/// A material a body, with Blender's meaning of Ns, Ks and Ka, and the physically based extension (Pr, Pm,
/// ...) for tools that know it. Colours are linear.
std::string obj_library(const ExportedScene&);

}  // namespace lagomorph::apps
