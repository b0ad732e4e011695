#include <algorithm>
#include <limits>

#include "render/backends.h"

namespace lagomorph::render {
namespace {

/// Draws nothing, at once: black colour, infinite depth. For tests of what stands around a renderer.
class NullRenderer final : public Renderer {
public:
  explicit NullRenderer(const RenderSettings& settings) : settings_(settings) {}
  std::string_view name() const override { return "null"; }
  void set_scene(const RenderScene&) override {}
  void update_positions(int, std::span<const Vec3>) override {}
  void update_colors(int, std::span<const Color>) override {}
  Image render(const Camera& camera, const FrameInfo&) override {
    Image image(camera.width(), camera.height());
    image.add("color", 3);
    if (settings_.transparent) image.add(alpha_channel, 1);
    for (const std::string& channel : settings_.channels) {
      if (channel == color_channel) continue;
      const ChannelKind& kind = channel_kind(channel);
      std::vector<float>& values = image.add(channel, kind.components, kind.cell);
      std::fill(values.begin(), values.end(), std::numeric_limits<float>::infinity());
    }
    return image;
  }
  std::string description() const override { return "null"; }

private:
  RenderSettings settings_;
};

}  // namespace

std::unique_ptr<Renderer> make_null_renderer(const RenderSettings& settings, int) {
  return std::make_unique<NullRenderer>(settings);
}

}  // namespace lagomorph::render
