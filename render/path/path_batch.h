#pragma once

#include <vector>

#include "render/path/path_tracer.h"
#include "render/path/surface_rows.h"

namespace lagomorph::render::path {

/// The rows of a batch, too large for a stack.
struct PathTracer::Batch {
  Row<MeshHit> hits;  // of the paths' rays
  Meetings meetings;
  Row<std::uint32_t> meeting;  // of each ray that meets a mesh
  GroundRows ground;
  Row3<> met;  // light of area lights that scattered rays meet
  Row<float> to_light;
  Row3<> behind;  // light of the sky, or the background, where the rays go
  SurfaceRows surfaces;
  SurfaceRow<std::uint32_t> light;  // picked for each surface
  PairRows pairs, choices;
  ArrivingRows arriving;
  ScatterRows scattered;
  std::vector<Range> meshes;         // the meetings of each mesh
  std::vector<SurfaceRange> ranges;  // of surfaces of a material
};

}  // namespace lagomorph::render::path
