#pragma once

#include "apps/scene/keys.h"

/// Keys of what looks: the camera, its moves and panels.
namespace lagomorph::apps {

void visit_camera(CameraDesc&, KeyVisitor&);
void visit_panel(PanelDesc&, KeyVisitor&);
void visit_layout(LayoutDesc&, KeyVisitor&);

}  // namespace lagomorph::apps
