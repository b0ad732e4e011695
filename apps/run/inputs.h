#pragma once

#include "apps/run/paths.h"
#include "apps/scene/scene_desc.h"

namespace lagomorph::apps {

/// The same scene with its files where RUN keeps them: `inputs/bunny.msh`, directory RUN. Files of one name
/// in several folders get numbers; a scene that stands in RUN already keeps its names.
SceneDesc self_contained(const SceneDesc&, const RunPaths&);

/// Copies every file that the scene names into RUN/inputs and removes what else is there, then writes
/// RUN/scene.toml.
void write_inputs(const SceneDesc&, const RunPaths&);

}  // namespace lagomorph::apps
