#pragma once

#include <vector>

#include "apps/scene/scene_desc.h"

namespace lagomorph::apps {

/// Where a panel is in the picture, from its top left corner. [pixels]
struct PanelPlace {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The place of each panel, row by row; of a scene without panels the whole picture.
std::vector<PanelPlace> panel_places(const SceneDesc&);

/// The scene as a panel shows it: its camera and fields, in a picture of its own. Without panels the scene.
SceneDesc panel_scene(const SceneDesc&, std::size_t panel);

/// Whether a body shows a field, in some panel at least.
bool shows_field(const SceneDesc&, std::size_t body);

}  // namespace lagomorph::apps
