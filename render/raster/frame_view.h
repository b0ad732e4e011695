#pragma once

#include "render/camera.h"
#include "render/raster/frame_block.h"
#include "render/raster/view_range.h"

namespace lagomorph::render::raster {

/// The camera into the frame's block, and the level of detail at which it sees the sky's map.
void set_view(const Camera&, const ViewRange&, const Sky&, FrameBlock&);

}  // namespace lagomorph::render::raster
