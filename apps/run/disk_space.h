#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/run/plan.h"
#include "render/settings.h"

namespace lagomorph::apps {

/// What the frames of a plan will take on disk. [bytes]
struct ExpectedSize {
  std::size_t least = 0;     // states and channels, whose sizes are known, and well compressed pictures
  std::size_t estimate = 0;  // with pictures as they usually compress
};
ExpectedSize expected_size(const std::vector<FrameJob>&, int vertices, int levels,
                           const render::RenderSettings&);

/// Throws Error(machine) when less is free where the folder is (or will be) than the run takes at least.
void require_space(const std::filesystem::path& folder, const ExpectedSize&);

/// "1.2 MB"
std::string size_text(std::size_t bytes);

}  // namespace lagomorph::apps
