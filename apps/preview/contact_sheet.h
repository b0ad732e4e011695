#pragma once

#include "apps/preview/material.h"
#include "apps/preview/shown.h"
#include "render/color.h"

namespace lagomorph::apps {

/// The frames of a contact sheet: at most 20 of those shown, evenly.
std::vector<const ShownFrame*> sheet_frames(const Shown&);

/// The contact sheet: the run in a line or two, then frames in rows, each with its number and time below;
/// what cannot be read is an empty frame that says so.
render::Picture contact_sheet(const PreviewMaterial&, const Shown&);

}  // namespace lagomorph::apps
