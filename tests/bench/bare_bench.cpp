#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include "render/raster/gl_context.h"
#include "render/raster/gl_objects.h"
#include "render/raster/mesh_buffers.h"
#include "tests/bench/drawing.h"
#include "tests/bench/forward_frame.h"

/// Frames against what the libraries under them need for the same: the path tracer against Embree alone on
/// the very rays that it traced, the rasterizer against a cleared and a plainly drawn framebuffer that is
/// read back.
namespace lagomorph::bench {
namespace {

struct RecordedRay {
  RTCRay ray;
  bool occlusion;  // or the closest hit
};
RTCScene recorded_scene = nullptr;
std::vector<RecordedRay>* recording = nullptr;  // while one thread draws

template <int N, class Rays>
void record(const int* valid, RTCScene scene, const Rays& rays, bool occlusion) {
  if (recording == nullptr) return;
  recorded_scene = scene;
  for (int k = 0; k < N; ++k) {
    if (valid[k] == 0) continue;
    recording->push_back(
        {{rays.org_x[k], rays.org_y[k], rays.org_z[k], rays.tnear[k], rays.dir_x[k], rays.dir_y[k],
          rays.dir_z[k], rays.time[k], rays.tfar[k], rays.mask[k], rays.id[k], rays.flags[k]},
         occlusion});
  }
}

}  // namespace
}  // namespace lagomorph::bench

// The linker's --wrap puts these before Embree's calls of the path tracer, so that it knows nothing of it.
// NOLINTBEGIN(bugprone-reserved-identifier)
#define LAGOMORPH_WRAP(N)                                                                                \
  extern "C" void __real_rtcIntersect##N(const int*, RTCScene, RTCIntersectContext*, RTCRayHit##N*);     \
  extern "C" void __wrap_rtcIntersect##N(const int* valid, RTCScene scene, RTCIntersectContext* context, \
                                         RTCRayHit##N* rays) {                                           \
    lagomorph::bench::record<N>(valid, scene, rays->ray, false);                                         \
    __real_rtcIntersect##N(valid, scene, context, rays);                                                 \
  }                                                                                                      \
  extern "C" void __real_rtcOccluded##N(const int*, RTCScene, RTCIntersectContext*, RTCRay##N*);         \
  extern "C" void __wrap_rtcOccluded##N(const int* valid, RTCScene scene, RTCIntersectContext* context,  \
                                        RTCRay##N* rays) {                                               \
    lagomorph::bench::record<N>(valid, scene, *rays, true);                                              \
    __real_rtcOccluded##N(valid, scene, context, rays);                                                  \
  }
LAGOMORPH_WRAP(4)
LAGOMORPH_WRAP(8)
LAGOMORPH_WRAP(16)
#undef LAGOMORPH_WRAP
// NOLINTEND(bugprone-reserved-identifier)

namespace lagomorph::bench {
namespace {

using Clock = std::chrono::steady_clock;
/// What some work takes, whose result is not to be left out [s].
template <class Work>
double seconds_of(const Work& work) {
  const Clock::time_point start = Clock::now();
  benchmark::DoNotOptimize(work());
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One by one, on this thread, in the hierarchy in which they were traced; how many met something.
std::size_t trace_bare(const std::vector<RecordedRay>& rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::size_t met = 0;
  for (const RecordedRay& r : rays) {
    if (r.occlusion) {
      RTCRay ray = r.ray;
      rtcOccluded1(recorded_scene, &context, &ray);
      met += ray.tfar < 0.0F ? 1 : 0;
    } else {
      RTCRayHit ray{};
      ray.ray = r.ray;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(recorded_scene, &context, &ray);
      met += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
  }
  return met;
}

/// A frame of four samples a pixel on one thread, then its rays bare.
void path_against_bare(benchmark::State& timing) {
  Drawing drawing("path", 4, 640, 360, 1);
  std::vector<RecordedRay> rays;
  recording = &rays;
  drawing.draw();
  recording = nullptr;
  double path = 0.0, bare = 0.0;
  for (auto _ : timing) {
    path += seconds_of([&] { return drawing.draw(); });
    bare += seconds_of([&] { return trace_bare(rays); });
  }
  const double all = static_cast<double>(rays.size()) * static_cast<double>(timing.iterations());
  timing.counters["path rays/s"] = all / path;
  timing.counters["bare rays/s"] = all / bare;
  timing.counters["times bare"] = path / bare;
}

/// A context of its own with a picture like the rasterizer's: RGBA of 32-bit floats, of four samples too.
class BareFrame {
public:
  BareFrame(int width, int height)
      : width_(width), height_(height), context_(render::raster::make_gl_context(threads)) {
    gl_ = std::make_unique<Gl>();
    using namespace render::raster;
    for (const bool several : {false, true}) {
      const Gl::Target& to = several ? gl_->several : gl_->single;
      bind(to.framebuffer, width, height);
      glBindRenderbuffer(GL_RENDERBUFFER, to.color.id());
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, several ? 4 : 0, GL_RGBA32F, width, height);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, to.color.id());
      glBindRenderbuffer(GL_RENDERBUFFER, to.depth.id());
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, several ? 4 : 0, GL_DEPTH_COMPONENT32F, width,
                                       height);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, to.depth.id());
      check_framebuffer("bare frame");
    }
  }
  ~BareFrame() {
    context_->make_current();
    gl_.reset();
  }
  BareFrame(const BareFrame&) = delete;
  BareFrame& operator=(const BareFrame&) = delete;

  const std::vector<float>& clear_and_read() {
    context_->make_current();
    render::raster::bind(gl_->single.framebuffer, width_, height_);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    return read();
  }

  /// All triangles under one light without shadows.
  const std::vector<float>& draw_and_read(const render::Mesh& mesh, const render::Camera& camera) {
    using namespace render::raster;
    context_->make_current();
    if (!gl_->mesh) gl_->mesh.emplace(mesh);
    bind(gl_->several.framebuffer, width_, height_);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    gl_->program.use();
    const render::Mat4 clip = camera.projection(0.1F, 20.0F) * camera.view();
    glUniformMatrix4fv(gl_->program.location("clip_from_world"), 1, GL_FALSE, clip.data());
    gl_->mesh->upload(mesh.positions);
    gl_->mesh->draw();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, gl_->single.framebuffer.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return read();
  }

private:
  struct Gl {
    struct Target {
      render::raster::Renderbuffer color, depth;
      render::raster::Framebuffer framebuffer;
    };
    Target single, several;
    std::optional<render::raster::MeshBuffers> mesh;
    render::raster::Program program{"bare",
                                    {R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world;
out vec3 n;
void main() {
  n = normal;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)"},
                                    {R"(
in vec3 n;
out vec4 color;
void main() { color = vec4(vec3(max(dot(normalize(n), vec3(0.3, 0.8, 0.52)), 0.0)), 1.0); }
)"}};
  };

  const std::vector<float>& read() {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, gl_->single.framebuffer.id());
    pixels_.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels_.data());
    return pixels_;
  }

  int width_, height_;
  std::unique_ptr<render::raster::GlContext> context_;
  std::unique_ptr<Gl> gl_;
  std::vector<float> pixels_;
};

/// In turn: the rasterizer's frame, a framebuffer cleared and read back, and one with the same triangles.
void raster_against_bare(benchmark::State& timing) {
  Drawing drawing("raster", 1);
  BareFrame bare_frame(1280, 720);
  const render::Mesh mesh =
      apps::build_render_scene(drawing.s.scene, drawing.s.model, drawing.surfaces).meshes.front();
  drawing.draw();
  bare_frame.clear_and_read();
  bare_frame.draw_and_read(mesh, *drawing.camera);
  double frame = 0.0, cleared = 0.0, drawn = 0.0;
  for (auto _ : timing) {
    frame += seconds_of([&] { return drawing.draw(); });
    cleared += seconds_of([&] { return bare_frame.clear_and_read().data(); });
    drawn += seconds_of([&] { return bare_frame.draw_and_read(mesh, *drawing.camera).data(); });
  }
  const auto count = static_cast<double>(timing.iterations());
  timing.counters["frame ms"] = 1e3 * frame / count;
  timing.counters["cleared ms"] = 1e3 * cleared / count;
  timing.counters["drawn ms"] = 1e3 * drawn / count;
  timing.counters["times cleared"] = frame / cleared;
  timing.counters["times drawn"] = frame / drawn;
}

/// In turn: the rasterizer's frame, and a plain forward renderer's without and with shadow maps.
void raster_against_forward(benchmark::State& timing) {
  Drawing drawing("raster", 1);
  render::RenderScene scene = apps::build_render_scene(drawing.s.scene, drawing.s.model, drawing.surfaces);
  scene.meshes.front().positions = apps::to_render(drawing.surfaces.front().positions(drawing.s.state.q));
  ForwardFrame plain(scene, 1280, 720, threads, false), shadowed(scene, 1280, 720, threads, true);
  drawing.draw();
  plain.draw_and_read(*drawing.camera);
  shadowed.draw_and_read(*drawing.camera);
  double frame = 0.0, without = 0.0, with = 0.0;
  for (auto _ : timing) {
    frame += seconds_of([&] { return drawing.draw(); });
    without += seconds_of([&] { return plain.draw_and_read(*drawing.camera).data(); });
    with += seconds_of([&] { return shadowed.draw_and_read(*drawing.camera).data(); });
  }
  const auto count = static_cast<double>(timing.iterations());
  timing.counters["frame ms"] = 1e3 * frame / count;
  timing.counters["forward ms"] = 1e3 * without / count;
  timing.counters["with shadows ms"] = 1e3 * with / count;
  timing.counters["times forward"] = frame / without;
  timing.counters["times with shadows"] = frame / with;
}

BENCHMARK(path_against_bare)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(5);
BENCHMARK(raster_against_forward)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(20);
BENCHMARK(raster_against_bare)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(20);

}  // namespace
}  // namespace lagomorph::bench
