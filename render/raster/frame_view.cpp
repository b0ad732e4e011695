#include "render/raster/frame_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lagomorph::render::raster {

void set_view(const Camera& camera, const ViewRange& range, const Sky& sky, FrameBlock& block) {
  const Mat4 projection = camera.projection(range.near, range.far);
  const auto width = static_cast<float>(camera.width());
  const auto height = static_cast<float>(camera.height());
  block.clip_from_world = projection * camera.view();
  block.eye = vec4(camera.position(), camera.is_orthographic() ? 1.0F : 0.0F);
  block.forward = vec4(camera.forward(), 0.0F);
  block.right = vec4(Vec3(camera.right() / projection(0, 0)), 0.0F);
  block.up = vec4(Vec3(camera.up() / projection(1, 1)), 0.0F);
  block.viewport = Vec4(width, height, 1.0F / width, 1.0F / height);
  if (sky.map && !camera.is_orthographic()) {
    const float texels = 2.0F * block.up.norm() / height * static_cast<float>(sky.map->height()) /
                         std::numbers::pi_v<float>;  // in a pixel
    block.sky_picture.y() = std::max(std::log2(texels), 0.0F);
  }
}

}  // namespace lagomorph::render::raster
