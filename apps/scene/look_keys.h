#pragma once

#include "apps/scene/keys.h"

/// Keys of how a surface is drawn.
namespace lagomorph::apps {

void visit_look(render::Material&, KeyVisitor&);
/// And those of the principled material that the path tracer draws.
void visit_body_look(render::Material&, KeyVisitor&);

}  // namespace lagomorph::apps
