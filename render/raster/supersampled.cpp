#include "render/raster/supersampled.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

namespace lagomorph::render::raster {
namespace {

bool has_mean(const std::string& channel) { return channel == color_channel || channel == alpha_channel; }

RenderSettings finer(RenderSettings s) {
  const int factor = std::exchange(s.raster.supersample, 1);
  s.width *= factor;
  s.height *= factor;
  std::erase_if(s.channels, [](const std::string& channel) { return !has_mean(channel); });
  return s;
}

RenderSettings of_centres(RenderSettings s) {
  s.raster.supersample = 1;
  return s;
}

/// Means of squares of the fine channel's pixels.
void reduce(const Channel& fine, int factor, int width, int height, std::vector<float>& to) {
  const auto n = static_cast<std::size_t>(fine.components), by = static_cast<std::size_t>(factor);
  const auto across = static_cast<std::size_t>(width);
  const float part = 1.0F / static_cast<float>(factor * factor);
  tbb::parallel_for(0, height, [&](int row) {
    const auto y = static_cast<std::size_t>(row);
    for (std::size_t x = 0; x < across; ++x) {
      for (std::size_t c = 0; c < n; ++c) {
        float sum = 0.0F;
        for (std::size_t j = 0; j < by; ++j) {
          const float* from = fine.values.data() + ((y * by + j) * across + x) * by * n + c;
          for (std::size_t i = 0; i < by; ++i) sum += from[i * n];
        }
        to[(y * across + x) * n + c] = part * sum;
      }
    }
  });
}

class Supersampled final : public Renderer {
public:
  Supersampled(const RenderSettings& settings, const MakeRenderer& make)
      : factor_(settings.raster.supersample), fine_(make(finer(settings))) {
    if (!std::all_of(settings.channels.begin(), settings.channels.end(), has_mean))
      centres_ = make(of_centres(settings));
  }

  std::string_view name() const override { return fine_->name(); }
  void set_scene(const RenderScene& scene) override {
    for_each([&](Renderer& r) { r.set_scene(scene); });
  }
  void update_positions(int mesh, std::span<const Vec3> positions) override {
    for_each([&](Renderer& r) { r.update_positions(mesh, positions); });
  }
  void update_colors(int mesh, std::span<const Color> colors) override {
    for_each([&](Renderer& r) { r.update_colors(mesh, colors); });
  }
  void set_previous(int mesh, std::span<const Vec3> positions) override {
    if (centres_) centres_->set_previous(mesh, positions);
  }
  Image render(const Camera& camera, const FrameInfo& frame) override {
    FrameInfo still = frame;
    still.camera_before = nullptr;
    if (still.region)
      for (int* border : {&still.region->x0, &still.region->y0, &still.region->x1, &still.region->y1})
        *border *= factor_;
    const Image fine = fine_->render(camera.enlarged(factor_), still);
    Image image = centres_ ? centres_->render(camera, frame) : Image(camera.width(), camera.height());
    for (const Channel& channel : fine.channels())
      reduce(channel, factor_, camera.width(), camera.height(), image.add(channel.name, channel.components));
    return image;
  }
  double seconds_reading_back() const override {
    return fine_->seconds_reading_back() + (centres_ ? centres_->seconds_reading_back() : 0.0);
  }
  std::string description() const override { return fine_->description(); }

private:
  template <class Do>
  void for_each(const Do& act) {
    act(*fine_);
    if (centres_) act(*centres_);
  }

  int factor_;
  std::unique_ptr<Renderer> fine_;
  std::unique_ptr<Renderer> centres_;  // where other channels are wanted
};

}  // namespace

std::unique_ptr<Renderer> make_supersampled(const RenderSettings& settings, const MakeRenderer& make) {
  return std::make_unique<Supersampled>(settings, make);
}

}  // namespace lagomorph::render::raster
