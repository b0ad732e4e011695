#pragma once

#include <optional>

#include "apps/scene/keys.h"

/// Keys of what is around the bodies: the floor, lights, the sky.
namespace lagomorph::apps {

void visit_ground(render::Ground&, KeyVisitor&);
void visit_light(LightDesc&, KeyVisitor&);
void visit_sky(SkyDesc&, KeyVisitor&);
void visit_background(std::optional<render::Color>&, KeyVisitor&);

}  // namespace lagomorph::apps
