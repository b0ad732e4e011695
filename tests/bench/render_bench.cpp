#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "render/camera.h"
#include "render/channels.h"
#include "render/color.h"
#include "render/denoise.h"
#include "render/image_compare/compare.h"
#include "render/path/ray_caster.h"
#include "render/png.h"
#include "render/png_read.h"
#include "render/renderer.h"
#include "tests/bench/drawing.h"
#include "tests/bench/scene.h"

/// A frame from the positions of its vertices to the bytes of its file, at the main job's settings, and the
/// comparison of two pictures.
namespace lagomorph::bench {
namespace {

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

/// Rays of a picture through Embree alone, on one thread: the camera's, in packets or one by one.
void bare_rays(benchmark::State& timing) {
  Drawing drawing("path", 1);
  render::RenderScene scene = apps::build_render_scene(drawing.s.scene, drawing.s.model, drawing.surfaces);
  render::path::RayCaster caster;
  caster.build(scene.meshes);
  caster.commit();
  const auto coherence =
      timing.range(0) != 0 ? render::path::Coherence::coherent : render::path::Coherence::incoherent;
  std::vector<render::Ray> rays;
  for (int y = 0; y < drawing.camera->height(); ++y)
    for (int x = 0; x < drawing.camera->width(); ++x)
      rays.push_back(drawing.camera->ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F));
  std::vector<render::path::MeshHit> hits(rays.size());
  constexpr std::size_t batch = 1024;
  for (auto _ : timing) {
    for (std::size_t i = 0; i < rays.size(); i += batch) {
      const std::size_t n = std::min(batch, rays.size() - i);
      caster.intersect({rays.data() + i, n}, coherence, {hits.data() + i, n});
    }
    benchmark::DoNotOptimize(hits.data());
  }
  timing.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays.size()), benchmark::Counter::kIsIterationInvariantRate);
}

/// Of a picture of four samples a pixel, at 1280 x 720.
void denoiser(benchmark::State& timing) {
  render::RenderSettings settings = swing("5k").scene.render;
  settings.backend = "path";
  settings.samples = 4;
  settings.channels = {render::variance_channel, render::denoising_albedo_channel,
                       render::denoising_normal_channel, render::denoising_depth_channel};
  Swing& s = swing("5k");
  const std::vector<sim::Surface> surfaces = apps::build_surfaces(s.scene, s.model, s.progress);
  const auto renderer = render::make_renderer(settings, threads);
  renderer->set_scene(apps::build_render_scene(s.scene, s.model, surfaces));
  const render::Image image =
      renderer->render(render::Camera(s.scene.camera, settings.width, settings.height), {});
  const auto of = [&](const char* channel) { return std::span<const float>(image.find(channel)->values); };
  const render::NoisyPicture noisy = {.width = image.width(),
                                      .height = image.height(),
                                      .color = of(render::color_channel),
                                      .variance = of(render::variance_channel),
                                      .albedo = of(render::denoising_albedo_channel),
                                      .normal = of(render::denoising_normal_channel),
                                      .depth = of(render::denoising_depth_channel)};
  for (auto _ : timing) benchmark::DoNotOptimize(render::denoise(noisy, {}));
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
BENCHMARK(bare_rays)->ArgName("packets")->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(denoiser)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(2);
BENCHMARK(tone_curve)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(png)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(compare_1080p)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lagomorph::bench
