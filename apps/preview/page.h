#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/preview/material.h"
#include "apps/preview/page_frames.h"
#include "apps/preview/shown.h"

namespace lagomorph::apps {

/// index.html: one file that needs nothing else, no network and, but for the player's controls, no script.
std::string preview_page(const PreviewMaterial&, const Shown&, const std::vector<PageFrame>&);

/// The page's script.
extern const std::string_view player_script;

}  // namespace lagomorph::apps
