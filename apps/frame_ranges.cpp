#include "apps/frame_ranges.h"

namespace lagomorph::apps {

std::string ranges_text(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t last = i;
    while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(frames[i]);
    if (last > i) text += ".." + std::to_string(frames[last]);
    i = last + 1;
  }
  return text.empty() ? "none" : text;
}

}  // namespace lagomorph::apps
