#pragma once

#include <vector>

#include "render/camera.h"
#include "render/path/medium.h"
#include "render/path/ray_caster.h"
#include "render/path/sampler.h"
#include "render/path/scene_geometry.h"

namespace lagomorph::render::path {

/// Walks of light in cloudy insides, from where it enters a mesh to where it leaves it. Distances by the
/// extinction of a colour that is picked as the light left, all colours weighed together by the balance
/// heuristic [Chiang, Kutz and Burley 2016; Wilkie et al. 2014]. Dim walks end by Russian roulette. Other
/// meshes within are passed unseen. A walk that finds no way out, of a mesh with holes, is lost, as is one of
/// more than `most_steps` scatterings.
class RandomWalk {
public:
  /// `from` begins inside of its mesh.
  void begin(const Ray& from, std::uint32_t mesh, const CloudyInside&, const PathSamples&,
             std::uint32_t depth);

  struct Exit {
    bool found = false;
    Vec3 origin = Vec3::Zero();  // of rays that go on outside
    Vec3 normal = Vec3::Zero();  // shading normal, outside
    Color weight = Color::Zero();
  };
  /// Ends all walks; their exits in the order in which they began, until the next call.
  const std::vector<Exit>& finish(const SceneGeometry&);

  static constexpr std::uint32_t most_steps = 4096;

private:
  struct Walk {
    const CloudyInside* inside;
    PathSamples samples;
    Color weight;
    std::uint32_t mesh;
    std::uint32_t exit;    // its place
    std::uint32_t number;  // of its next pair of samples
    std::uint32_t steps;
  };
  bool step(Walk&, Ray&, const MeshHit&, const SceneGeometry&);

  std::vector<Ray> rays_;  // of walks_
  std::vector<Walk> walks_;
  std::vector<MeshHit> hits_;
  std::vector<Exit> exits_;
  std::uint32_t begun_ = 0;
};

}  // namespace lagomorph::render::path
