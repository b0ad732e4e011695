#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "render/camera.h"
#include "render/color.h"
#include "render/image_compare/compare.h"
#include "render/png.h"
#include "render/png_read.h"
#include "render/renderer.h"
#include "tests/bench/scene.h"

/// A frame from the positions of its vertices to the bytes of its file, at the main job's settings, and the
/// comparison of two pictures.
namespace lagomorph::bench {
namespace {

constexpr int threads = 2;

struct Drawing {
  explicit Drawing(const std::string& backend, int samples, int width = 1280, int height = 720)
      : s(swing("5k")) {
    render::RenderSettings settings = s.scene.render;
    settings.backend = backend;
    settings.samples = samples;
    settings.width = width;
    settings.height = height;
    camera = std::make_unique<render::Camera>(s.scene.camera, width, height);
    surfaces = apps::build_surfaces(s.scene, s.model, s.progress);
    renderer = render::make_renderer(settings, threads);
    renderer->set_scene(apps::build_render_scene(s.scene, s.model, surfaces));
  }
  render::Image draw() {
    apps::move_meshes(*renderer, surfaces, s.state.q);
    return renderer->render(*camera, {});
  }

  Swing& s;
  std::unique_ptr<render::Camera> camera;
  std::vector<sim::Surface> surfaces;
  std::unique_ptr<render::Renderer> renderer;
};

void raster_frame(benchmark::State& timing) {
  Drawing drawing("raster", 1);
  for (auto _ : timing) benchmark::DoNotOptimize(drawing.draw());
}

void path_frame(benchmark::State& timing) {
  const int samples = static_cast<int>(timing.range(0));
  Drawing drawing("path", samples);
  for (auto _ : timing) benchmark::DoNotOptimize(drawing.draw());
  timing.counters["samples/s"] =
      benchmark::Counter(1280.0 * 720.0 * samples, benchmark::Counter::kIsIterationInvariantRate);
}

void tone_curve(benchmark::State& timing) {
  Drawing drawing("raster", 1);
  const render::Image image = drawing.draw();
  for (auto _ : timing) benchmark::DoNotOptimize(render::tone_map(image, "pbr_neutral", 0.0F));
}

void png(benchmark::State& timing) {
  Drawing drawing("raster", 1);
  const render::Picture picture = render::tone_map(drawing.draw(), "pbr_neutral", 0.0F);
  for (auto _ : timing) benchmark::DoNotOptimize(render::encode_png(picture, 1));
}

void compare_1080p(benchmark::State& timing) {
  const auto pixels = [](double shift) {
    Drawing drawing("raster", 1, 1920, 1080);
    drawing.s.state.q.array() += shift;
    const render::Picture picture = render::tone_map(drawing.draw(), "pbr_neutral", 0.0F);
    drawing.s.state.q.array() -= shift;
    return render::read_png(render::encode_png(picture, 1), "picture");
  };
  const render::Pixels a = pixels(0.0), b = pixels(0.01);
  for (auto _ : timing) benchmark::DoNotOptimize(render::compare_pictures(a, b));
}

BENCHMARK(raster_frame)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(path_frame)->Arg(4)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(3);
BENCHMARK(tone_curve)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(png)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(compare_1080p)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lagomorph::bench
