#pragma once

#include "apps/scene/keys.h"

/// Keys of frames and steps, and of how a step is solved.
namespace lagomorph::apps {

void visit_time(sim::TimeSettings&, KeyVisitor&);
void visit_solver(sim::SolverSettings&, KeyVisitor&);

}  // namespace lagomorph::apps
