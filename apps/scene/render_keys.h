#pragma once

#include "apps/scene/keys.h"

/// Keys of the pictures and of what draws them.
namespace lagomorph::apps {

void visit_render(render::RenderSettings&, KeyVisitor&);

}  // namespace lagomorph::apps
