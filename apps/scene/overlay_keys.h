#pragma once

#include "apps/scene/keys.h"

/// Keys of what is drawn over the pictures.
namespace lagomorph::apps {

void visit_wireframe(WireframeDesc&, KeyVisitor&);
void visit_clip(ClipDesc&, KeyVisitor&);

}  // namespace lagomorph::apps
