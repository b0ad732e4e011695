#pragma once

#include "apps/scene/keys.h"

/// Keys of what is drawn over the pictures.
namespace lagomorph::apps {

void visit_wireframe(WireframeDesc&, KeyVisitor&);
void visit_ghost(GhostDesc&, KeyVisitor&);
void visit_labels(LabelsDesc&, KeyVisitor&);
void visit_caption(CaptionDesc&, KeyVisitor&);
void visit_clip(ClipDesc&, KeyVisitor&);
void visit_glyphs(GlyphsDesc&, KeyVisitor&);
void visit_energy_plot(EnergyPlotDesc&, KeyVisitor&);

}  // namespace lagomorph::apps
