#include "apps/pipeline/crop.h"

#include <utility>
#include <vector>

namespace lagomorph::apps {
namespace {

/// `components` values a pixel, in rows of `width` pixels.
template <class T>
std::vector<T> part(const std::vector<T>& values, int width, int components, const render::PixelRegion& r) {
  std::vector<T> kept;
  kept.reserve(static_cast<std::size_t>(components) * static_cast<std::size_t>(r.width()) *
               static_cast<std::size_t>(r.height()));
  for (int y = r.y0; y < r.y1; ++y) {
    const auto row = values.begin() + std::ptrdiff_t{components} * (std::ptrdiff_t{y} * width + r.x0);
    kept.insert(kept.end(), row, row + std::ptrdiff_t{components} * r.width());
  }
  return kept;
}

bool is_all(const render::PixelRegion& r, int width, int height) {
  return r.x0 == 0 && r.y0 == 0 && r.x1 == width && r.y1 == height;
}

}  // namespace

render::Channel cropped(const render::Channel& channel, const render::PixelRegion& region) {
  return {channel.name, channel.components, part(channel.values, channel.width, channel.components, region),
          region.width(), region.height()};
}

render::Image cropped(const render::Image& image, const render::PixelRegion& region) {
  render::Image kept(region.width(), region.height());
  for (const render::Channel& channel : image.channels())
    kept.add(channel.name, channel.components) = cropped(channel, region).values;
  return kept;
}

render::Picture cropped(render::Picture picture, const render::PixelRegion& region) {
  if (is_all(region, picture.width, picture.height)) return picture;
  render::Picture kept{region.width(), region.height(), part(picture.rgb, picture.width, 3, region)};
  if (!picture.alpha.empty()) kept.alpha = part(picture.alpha, picture.width, 1, region);
  return kept;
}

}  // namespace lagomorph::apps
