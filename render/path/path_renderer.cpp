#include <algorithm>
#include <optional>

#include <tbb/blocked_range2d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "render/backends.h"
#include "render/denoise.h"
#include "render/error.h"
#include "render/path/adaptive.h"
#include "render/path/filter.h"
#include "render/path/path_tracer.h"
#include "render/path/scene_geometry.h"
#include "render/path/seen_channels.h"
#include "render/path/tile_means.h"
#include "render/path/tile_statistics.h"

namespace lagomorph::render {
namespace {

constexpr int tile_size = 32;
static_assert(tile_size % statistics_cell == 0);

void check_range(const char* key, int value, int low, int high) {
  if (value >= low && value <= high) return;
  throw SettingsError(std::string(key) + " = " + std::to_string(value) + " must be in " +
                      std::to_string(low) + ".." + std::to_string(high));
}

class PathRenderer final : public Renderer {
public:
  PathRenderer(const RenderSettings& settings, int threads)
      : settings_(settings),
        filter_(settings.path.filter, settings.path.filter_radius),
        arena_(std::clamp(threads, 1, tbb::info::default_concurrency())) {
    check_range("render.samples", settings.samples, 1, 65536);
    check_range("render.path.bounces", settings.path.bounces, 0, 64);
    check_range("render.path.transmission_bounces", settings.path.transmission_bounces, 0, 256);
    if (!(settings.path.clamp >= 0.0F)) throw SettingsError("render.path.clamp must be >= 0");
    check_range("render.path.min_samples", settings.path.min_samples, 1, 65536);
    if (!(settings.path.noise_threshold >= 0.0F))
      throw SettingsError("render.path.noise_threshold must be >= 0");
    if (settings.path.denoise && settings.samples < 2)
      throw SettingsError("render.path.denoise needs render.samples >= 2, of which it learns the noise");
    if (settings.path.noise_threshold > 0.0F && wants(statistics_channel)) {
      throw SettingsError("render.channels: '" + std::string(statistics_channel) +
                          "' needs the same samples everywhere: render.path.noise_threshold = 0");
    }
  }

  std::string_view name() const override { return "path"; }

  void set_scene(const RenderScene& scene) override {
    check_scene(scene);
    scene_ = scene;
    apply_transparency(settings_, scene_);
    arena_.execute([&] { geometry_.emplace(scene_); });
    shading_.emplace(scene_);
  }

  void update_colors(int mesh, std::span<const Color> colors) override {
    const Mesh& m = mesh_of(mesh);
    check_colors("mesh '" + m.name + "'", m.colors.size(), colors);
    geometry_->color(mesh, colors);
  }

  void update_positions(int mesh, std::span<const Vec3> positions) override {
    check_positions(mesh_of(mesh), positions);
    geometry_->move(mesh, positions);
  }

  bool draws_motion_blur() const override { return true; }

  void set_motion(int mesh, std::span<const std::vector<Vec3>> positions) override {
    const Mesh& m = mesh_of(mesh);
    if (positions.size() != static_cast<std::size_t>(scene_.motion_segments)) {
      throw SettingsError("the scene has " + std::to_string(scene_.motion_segments) +
                          " segments of motion; positions of " + std::to_string(positions.size()) +
                          " times were given");
    }
    for (const std::vector<Vec3>& step : positions) check_positions(m, step);
    geometry_->set_motion(mesh, positions);
  }

  void set_previous(int mesh, std::span<const Vec3> positions) override {
    geometry_->set_previous(mesh, positions);
  }

  Image render(const Camera& camera, const FrameInfo& frame) override {
    if (!geometry_) throw SettingsError("the path tracer has no scene");
    Image image(camera.width(), camera.height());
    geometry_->show_ground(scene_.ground.enabled && !frame.leaves_out_ground);
    arena_.execute([&] {
      geometry_->commit();
      float* statistics = wants(statistics_channel)
                              ? image.add(statistics_channel, statistics_components, statistics_cell).data()
                              : nullptr;
      float* counts = nullptr;
      if (wants(sample_count_channel)) {
        std::vector<float>& values = image.add(sample_count_channel, 1);
        std::fill(values.begin(), values.end(), static_cast<float>(settings_.samples));
        counts = values.data();
      }
      // The denoiser's guides are drawn whether or not they are asked for.
      Image guides(camera.width(), camera.height());
      const auto mean = [&](const char* channel) {
        float* const asked_for = wanted(image, channel);
        return asked_for != nullptr || !settings_.path.denoise
                   ? asked_for
                   : guides.add(channel, channel_kind(channel).components).data();
      };
      const path::MeanChannels means = {.albedo = mean(denoising_albedo_channel),
                                        .normal = mean(denoising_normal_channel),
                                        .depth = mean(denoising_depth_channel),
                                        .variance = mean(variance_channel),
                                        .alpha = settings_.transparent || wants(alpha_channel)
                                                     ? image.add(alpha_channel, 1).data()
                                                     : nullptr};
      std::vector<float>& color = image.add(color_channel, 3);
      draw_color(camera, frame, color, statistics, counts, means);
      if (settings_.path.denoise) {
        const std::size_t pixels = color.size() / 3;
        color = denoise({.width = camera.width(),
                         .height = camera.height(),
                         .color = color,
                         .variance = {means.variance, 3 * pixels},
                         .albedo = {means.albedo, 3 * pixels},
                         .normal = {means.normal, 3 * pixels},
                         .depth = {means.depth, pixels}},
                        {});
      }
      const path::SeenChannels seen = {.depth = wanted(image, depth_channel),
                                       .normal = wanted(image, normal_channel),
                                       .albedo = wanted(image, albedo_channel),
                                       .position = wanted(image, position_channel),
                                       .motion = wanted(image, motion_channel),
                                       .body_id = wanted(image, body_id_channel),
                                       .triangle_id = wanted(image, triangle_id_channel)};
      const path::SeenScene scene = {*geometry_, *shading_, scene_.meshes, camera,
                                     frame.camera_before != nullptr ? *frame.camera_before : camera};
      if (seen.any())
        for_tiles(camera, frame, [&](const path::Tile& tile) { write_seen(scene, tile, seen); });
    });
    return image;
  }

  std::string description() const override {
    return "path: " + (geometry_ ? geometry_->caster().description() : path::RayCaster().description());
  }

private:
  const Mesh& mesh_of(int mesh) const {
    if (mesh < 0 || static_cast<std::size_t>(mesh) >= scene_.meshes.size()) {
      throw SettingsError("mesh " + std::to_string(mesh) + " is not one of the scene's " +
                          std::to_string(scene_.meshes.size()));
    }
    return scene_.meshes[static_cast<std::size_t>(mesh)];
  }

  static void check_positions(const Mesh& m, std::span<const Vec3> positions) {
    if (positions.size() != m.positions.size()) {
      throw SettingsError("mesh '" + m.name + "' has " + std::to_string(m.positions.size()) + " positions; " +
                          std::to_string(positions.size()) + " were given");
    }
    if (!std::all_of(positions.begin(), positions.end(), [](const Vec3& p) { return p.allFinite(); })) {
      throw SettingsError("mesh '" + m.name + "' has a position that is not finite");
    }
  }

  bool wants(const char* channel) const {
    return std::find(settings_.channels.begin(), settings_.channels.end(), channel) !=
           settings_.channels.end();
  }

  /// The values of a channel, which is added; nullptr where it is not wanted.
  float* wanted(Image& image, const char* channel) const {
    return wants(channel) ? image.add(channel, channel_kind(channel).components).data() : nullptr;
  }

  /// Whether a tile has pixels that are asked for; what is drawn of it does not depend on the others.
  bool is_drawn(int x, int y, const std::optional<PixelRegion>& region) const {
    if (!region) return true;
    const PixelRegion& r = *region;
    const int around = settings_.path.denoise ? denoising_reach({}) : 0;
    return x < r.x1 + around && x + tile_size > r.x0 - around && y < r.y1 + around &&
           y + tile_size > r.y0 - around;
  }

  template <class Body>
  void for_tiles(const Camera& camera, const FrameInfo& frame, const Body& body) const {
    const int columns = (camera.width() + tile_size - 1) / tile_size;
    const int rows = (camera.height() + tile_size - 1) / tile_size;
    tbb::parallel_for(
        tbb::blocked_range<int>(0, columns * rows, 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int i = range.begin(); i != range.end(); ++i) {
            const int x = i % columns * tile_size;
            const int y = i / columns * tile_size;
            if (!is_drawn(x, y, frame.region)) continue;
            body(path::Tile{x, y, std::min(x + tile_size, camera.width()),
                            std::min(y + tile_size, camera.height())});
          }
        },
        tbb::simple_partitioner());
  }

  /// And the channels of statistics, sample counts and means where they are not nullptr.
  void draw_color(const Camera& camera, const FrameInfo& frame, std::vector<float>& color, float* statistics,
                  float* counts, const path::MeanChannels& mean_channels) const {
    const path::AdaptiveSampling adaptive{settings_.path.min_samples, settings_.samples,
                                          static_cast<double>(settings_.path.noise_threshold)};
    const path::FrameSamples numbers(settings_.path.seed, frame.frame, settings_.samples);
    const std::span<const Camera> open =
        geometry_->moving() ? frame.shutter_cameras : std::span<const Camera>();
    tbb::enumerable_thread_specific<path::PathTracer> tracers([&] {
      return path::PathTracer(*geometry_, *shading_, camera, open, filter_, settings_.samples,
                              settings_.path);
    });
    for_tiles(camera, frame, [&](const path::Tile& tile) {
      std::optional<path::TileMeans> means;
      if (mean_channels.any()) means.emplace(tile, mean_channels, camera.width());
      path::TileMeans* kept = means ? &*means : nullptr;
      if (adaptive.threshold > 0.0) {
        path::trace_adaptively(tracers.local(), tile, numbers, adaptive, camera.width(), color.data(), counts,
                               kept);
        if (means) means->write();
        return;
      }
      std::optional<path::TileStatistics> cells;
      if (statistics != nullptr) cells.emplace(tile, settings_.samples);
      tracers.local().trace(tile, numbers, color.data(), cells ? &*cells : nullptr, kept);
      if (cells) cells->write(camera.width(), statistics);
      if (means) means->write();
    });
  }

  RenderSettings settings_;
  path::PixelFilter filter_;
  mutable tbb::task_arena arena_;
  RenderScene scene_;
  std::optional<path::SceneGeometry> geometry_;
  std::optional<path::Shading> shading_;
};

}  // namespace

std::unique_ptr<Renderer> make_path_renderer(const RenderSettings& settings, int threads) {
  return std::make_unique<PathRenderer>(settings, threads);
}

}  // namespace lagomorph::render
