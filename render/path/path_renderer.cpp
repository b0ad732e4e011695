#include <algorithm>
#include <optional>

#include <tbb/blocked_range2d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "render/backends.h"
#include "render/error.h"
#include "render/path/adaptive.h"
#include "render/path/filter.h"
#include "render/path/path_tracer.h"
#include "render/path/scene_geometry.h"
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
    if (settings.path.noise_threshold > 0.0F && wants(statistics_channel)) {
      throw SettingsError("render.channels: '" + std::string(statistics_channel) +
                          "' needs the same samples everywhere: render.path.noise_threshold = 0");
    }
  }

  std::string_view name() const override { return "path"; }

  void set_scene(const RenderScene& scene) override {
    check_scene(scene);
    scene_ = scene;
    arena_.execute([&] { geometry_.emplace(scene_); });
    shading_.emplace(scene_);
  }

  void update_colors(int mesh, std::span<const Color> colors) override {
    const Mesh& m = mesh_of(mesh);
    check_colors("mesh '" + m.name + "'", m.colors.size(), colors);
    geometry_->color(mesh, colors);
  }

  void update_positions(int mesh, std::span<const Vec3> positions) override {
    const Mesh& m = mesh_of(mesh);
    if (positions.size() != m.positions.size()) {
      throw SettingsError("mesh '" + m.name + "' has " + std::to_string(m.positions.size()) + " positions; " +
                          std::to_string(positions.size()) + " were given");
    }
    if (!std::all_of(positions.begin(), positions.end(), [](const Vec3& p) { return p.allFinite(); })) {
      throw SettingsError("mesh '" + m.name + "' has a position that is not finite");
    }
    geometry_->move(mesh, positions);
  }

  void set_opening(int mesh, std::span<const Vec3> positions) override {
    if (scene_.moving) geometry_->open(mesh, positions);
  }

  Image render(const Camera& camera, const FrameInfo& frame) override {
    if (!geometry_) throw SettingsError("the path tracer has no scene");
    Image image(camera.width(), camera.height());
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
      draw_color(camera, frame.frame, image.add("color", 3), statistics, counts);
      if (wants(depth_channel)) draw_depth(camera, image.add(depth_channel, 1));
      if (wants(body_id_channel)) draw_body_ids(camera, image.add(body_id_channel, 1));
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

  bool wants(const char* channel) const {
    return std::find(settings_.channels.begin(), settings_.channels.end(), channel) !=
           settings_.channels.end();
  }

  /// Whether a tile has pixels that are asked for; what is drawn of it does not depend on the others.
  bool is_drawn(int x, int y) const {
    const PixelRegion r = settings_.drawn();
    return settings_.region.empty() || (x < r.x1 && x + tile_size > r.x0 && y < r.y1 && y + tile_size > r.y0);
  }

  template <class Body>
  void for_tiles(const Camera& camera, const Body& body) const {
    const int columns = (camera.width() + tile_size - 1) / tile_size;
    const int rows = (camera.height() + tile_size - 1) / tile_size;
    tbb::parallel_for(
        tbb::blocked_range<int>(0, columns * rows, 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int i = range.begin(); i != range.end(); ++i) {
            const int x = i % columns * tile_size;
            const int y = i / columns * tile_size;
            if (!is_drawn(x, y)) continue;
            body(path::Tile{x, y, std::min(x + tile_size, camera.width()),
                            std::min(y + tile_size, camera.height())});
          }
        },
        tbb::simple_partitioner());
  }

  /// And the channels of statistics and sample counts where they are not nullptr.
  void draw_color(const Camera& camera, int frame, std::vector<float>& color, float* statistics,
                  float* counts) const {
    const path::AdaptiveSampling adaptive{settings_.path.min_samples, settings_.samples,
                                          static_cast<double>(settings_.path.noise_threshold)};
    const path::FrameSamples numbers(settings_.path.seed, frame, settings_.samples);
    tbb::enumerable_thread_specific<path::PathTracer> tracers([&] {
      return path::PathTracer(*geometry_, *shading_, camera, filter_, settings_.samples, settings_.path);
    });
    for_tiles(camera, [&](const path::Tile& tile) {
      if (adaptive.threshold > 0.0) {
        path::trace_adaptively(tracers.local(), tile, numbers, adaptive, camera.width(), color.data(),
                               counts);
        return;
      }
      std::optional<path::TileStatistics> cells;
      if (statistics != nullptr) cells.emplace(tile, settings_.samples);
      tracers.local().trace(tile, numbers, color.data(), cells ? &*cells : nullptr);
      if (cells) cells->write(camera.width(), statistics);
    });
  }

  /// One ray through each pixel's centre: `seen(ray, hit, t)` gives the pixel's value of what it meets first,
  /// a mesh (hit.mesh) or the ground (hit.mesh is none), at a distance of t, infinite where there is nothing.
  /// The ground is a surface over its whole disc.
  template <class Seen>
  void draw_seen(const Camera& camera, std::vector<float>& channel, const Seen& seen) const {
    for_tiles(camera, [&](const path::Tile& tile) {
      std::array<Ray, tile_size * tile_size> rays;
      std::array<path::MeshHit, tile_size * tile_size> hits;
      std::size_t count = 0;
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
          rays[count++] = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        }
      }
      geometry_->caster().intersect(std::span(rays).first(count), path::Coherence::coherent, hits);
      std::size_t i = 0;
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x, ++i) {
          double t = geometry_->meet_ground(rays[i]);
          path::MeshHit hit = hits[i];
          if (hit.mesh != path::MeshHit::none) {
            const double to_mesh = geometry_->meet(rays[i], hit).t;
            if (to_mesh > t) hit.mesh = path::MeshHit::none;
            t = std::min(t, to_mesh);
          }
          const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width()) +
                             static_cast<std::size_t>(x);
          channel[pixel] = seen(rays[i], hit, t);
        }
      }
    });
  }

  void draw_depth(const Camera& camera, std::vector<float>& depth) const {
    draw_seen(camera, depth, [&](const Ray& ray, const path::MeshHit&, double t) {
      // The ray's length along the view axis; exactly its length where it is orthographic.
      return static_cast<float>(t * ray.direction.cast<double>().dot(camera.forward().cast<double>()));
    });
  }

  void draw_body_ids(const Camera& camera, std::vector<float>& ids) const {
    draw_seen(camera, ids, [&](const Ray&, const path::MeshHit& hit, double) {
      return hit.mesh == path::MeshHit::none
                 ? -1.0F
                 : static_cast<float>(scene_.meshes[static_cast<std::size_t>(hit.mesh)].body_id);
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
