#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/camera.h"
#include "render/path/filter.h"
#include "render/path/lens.h"
#include "render/path/random_walk.h"
#include "render/path/rows.h"
#include "render/path/sampler.h"
#include "render/path/scene_geometry.h"
#include "render/path/shading.h"
#include "render/path/surface_rows.h"
#include "render/render_scene.h"
#include "render/settings.h"

namespace lagomorph::render::path {

class TileStatistics;
class TileMeans;

/// What the camera sees first along a path.
struct FirstHit {
  Color albedo = Color::Zero();
  Vec3 normal = Vec3::Zero();  // unit shading normal, on the camera's side
  float depth = 0.0F;          // along the view axis [m]
  float opacity = 0.0F;        // of that surface: less than 1 where the ground fades, 0 where nothing is
  bool on_light = false;       // a visible light is seen, behind that surface or alone
  /// Of a shadow catcher: estimates of its irradiance, in luminance, without and with the meshes.
  bool catches = false;
  float light = 0.0F, reached = 0.0F;
};

/// A rectangle of pixels [x0, x1) x [y0, y1).
struct Tile {
  int x0, y0, x1, y1;
};

/// Traces the paths of one thread, a batch of them in step: all rays of a kind are traced together, in
/// packets, and surfaces whose material is a Brdf alone are lit and scatter in vector code (surface_rows.h).
/// Those with layers are vertices, one after another. Keeps its room from batch to batch.
///
/// At each surface, light arrives by next-event estimation of the area lights and the sky and by the
/// scattered ray that finds them (of suns likewise), weighed by the power heuristic [Veach 1997]. From the
/// fourth surface on, dim paths are ended by Russian roulette. The lights are no obstacle; one that is
/// visible is opaque to the camera.
///
/// Surfaces that are not opaque: a path stops at one with the probability of its opacity and else goes
/// straight on, which is no bounce; shadow rays lose that part of their light.
///
/// Clear insides: shadow rays do not pass them, light behind is found by the scattered ray alone. From
/// inside, what the surface lets out is estimated like any other light. Cloudy insides: a path that enters
/// one goes on where its random walk leaves the body, as if it had arrived there.
class PathTracer {
public:
  /// `shutter_cameras` as camera_at() takes them, of geometry that moves; none: the camera stands still.
  PathTracer(const SceneGeometry&, const Shading&, const Camera&, std::span<const Camera> shutter_cameras,
             const PixelFilter&, int samples, const PathSettings&);
  PathTracer(PathTracer&&) noexcept;
  ~PathTracer();

  /// Mean radiance of the tile's pixels into `color`, 3 floats a pixel of the whole picture. Sums go in the
  /// order of the samples. `statistics` and `means`, of the same tile, take every sample; nullptr: none is
  /// kept.
  void trace(const Tile&, const FrameSamples&, float* color, TileStatistics* statistics = nullptr,
             TileMeans* means = nullptr);

  struct PixelSample {
    int x, y, sample;
  };
  /// The radiance of single samples, one each. `means` as above.
  void trace(std::span<const PixelSample>, const FrameSamples&, std::span<Color> radiance,
             TileMeans* means = nullptr);

private:
  /// A surface with layers.
  struct Vertex {
    Vec3 origin;
    Vec3 t, b, n;  // shading frame
    const Bsdf* brdf;
    Bsdf::View view;  // in that frame
    Color throughput;
    float least_pdf;
    std::uint32_t lane;
    PathSamples samples;
    Vec3 below;  // origin of rays below the frame
    const Absorption* inside = nullptr;
    std::uint32_t clear = 0;
    float compressed = 1.0F;
  };

  /// What a ray meets.
  struct Ahead {
    double t;       // distance of the mesh; never when not on_mesh
    double ground;  // distance of the ground before the mesh, or never
    float opacity;  // of the ground there; 0 when never
    bool on_mesh;
    bool on_light = false;  // a visible light, as the camera sees it
  };
  /// A point of a shadow catcher.
  struct Caught {
    Vec3 point;
    float up;  // the side that is seen: 1 or -1
    std::uint32_t lane;
  };
  struct SurfaceRange {
    Range range;
    const BrdfConstants* material;
  };
  struct Batch;

  template <class Take, class Put>
  void trace_all(const Take&, const Put&, const FrameSamples&, TileMeans*);
  void begin_paths(std::span<const PixelSample>);
  Ray camera_ray(const Camera&, float px, float py, const PathSamples&) const;
  float depth_at(std::uint32_t lane, const Ray&, double distance) const;
  void trace_batch(std::uint32_t depth);
  void pass_through(std::uint32_t depth);
  bool passes(std::size_t path, std::uint32_t depth, std::uint32_t crossing) const;
  void meet_meshes();
  void meet_lights(std::uint32_t from);
  void arrive(std::uint32_t depth);
  void arrive_at_layers(std::size_t path, const Ahead&, std::uint32_t depth, float share);
  void see_surfaces(std::size_t on_meshes);
  TriangleHit hit_of(std::size_t path) const;
  Ahead look(std::size_t path) const;
  void see_background();
  Color seen_by_camera(std::size_t path, Ahead&) const;
  Color light_met(std::size_t path, const Ahead&) const;
  void keep_first_hit(std::uint32_t lane, const SurfacePoint&, const Color& albedo, float depth,
                      float opacity);
  void begin_vertex(const SurfacePoint&, const Ray&, std::size_t path, const Bsdf&, float share,
                    const Color* base_color);
  static void absorb(PathRows&, std::size_t path, const Absorption*, double distance);
  void enter_cloudy_inside(const Ray&, const MeshHit&, const Vec3& from, float choice, Pair way,
                           std::uint32_t depth);
  void leave_cloudy_insides();
  void add_light(std::uint32_t lane, const Color& light) {
    const float most = light.maxCoeff();
    const bool cut = clamp_ > 0.0F && indirect_[lane] != 0 && most > clamp_;
    radiance_[lane] += cut ? Color(clamp_ / most * light) : light;
  }
  bool all_lights_at(std::uint32_t depth) const;
  float pick_probability(std::size_t light, std::uint32_t depth) const;
  PathSamples samples_of(std::size_t lane) const { return {key_, SampleNumber{numbers_[lane]}}; }
  void draw_surface_pairs(std::uint32_t dimension, PairRows&) const;
  void gather_lights(std::uint32_t depth);
  void gather_light(const Vertex&, const RectangleLight&, float pick, Pair);
  void gather(const Vertex&, const Vec3& direction, float distance, float pdf, const Color& radiance);
  void gather_suns(std::uint32_t depth);
  void gather_sky(std::uint32_t depth);
  void shadow_surfaces();
  void push_shadow(const Ray&, float distance, const Color& arriving, std::uint32_t lane);
  void find_blocked(Coherence);
  void trace_shadows(Coherence);
  void catch_ground(std::size_t path, const Ahead&, float share);
  void catch_shadows();
  void push_caught(const Caught&, const Vec3& direction, float distance, float pdf, const Color& radiance);
  void trace_caught(Coherence);
  void dim_shadows(Coherence);
  void scatter(std::uint32_t depth);

  const SceneGeometry& geometry_;
  const Shading& shading_;
  const Camera& camera_;
  std::span<const Camera> shutter_cameras_;
  const PixelFilter& filter_;
  Aperture aperture_;
  bool moving_;  // rays have times
  int samples_;
  std::uint32_t bounces_, clear_bounces_;
  bool any_visible_ = false;  // of the lights
  float clamp_;               // of indirect light; 0: none

  std::unique_ptr<PathRows> paths_, next_;
  std::unique_ptr<ShadowRows> shadows_;
  std::unique_ptr<Batch> batch_;
  std::vector<Vertex> vertices_;
  std::vector<Caught> caught_;
  RandomWalk walks_;
  std::vector<Vertex> entered_;         // where each walk began
  std::vector<std::uint8_t> indirect_;  // by lane: light now comes over two counted surfaces or more
  std::vector<std::size_t> passing_;    // rays that go on behind a surface, their continuations and hits
  std::vector<Ray> passing_rays_;
  std::vector<MeshHit> passing_hits_;
  std::vector<Color> radiance_;       // of each lane
  std::vector<FirstHit> first_hits_;  // of each lane, where they are wanted

  std::uint64_t key_ = 0;  // of the batch's sample numbers, whose indices `numbers_` has by lane
  Row<std::uint32_t> numbers_{};
  Row<float> times_{};  // of each lane, where rays have them
};

}  // namespace lagomorph::render::path
