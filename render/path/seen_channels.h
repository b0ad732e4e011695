#pragma once

#include <span>

#include "render/camera.h"
#include "render/path/path_tracer.h"
#include "render/path/scene_geometry.h"

namespace lagomorph::render::path {

/// Where what one ray through each pixel's centre meets first goes: channels of the whole picture, see
/// channels.h; nullptr: not wanted. The ground is a surface over its whole disc.
struct SeenChannels {
  float* depth = nullptr;
  float* normal = nullptr;
  float* albedo = nullptr;
  float* position = nullptr;
  float* motion = nullptr;
  float* body_id = nullptr;
  float* triangle_id = nullptr;
  bool any() const {
    return depth != nullptr || normal != nullptr || albedo != nullptr || position != nullptr ||
           motion != nullptr || body_id != nullptr || triangle_id != nullptr;
  }
};

/// What those channels are made of.
struct SeenScene {
  const SceneGeometry& geometry;
  const Shading& shading;
  std::span<const Mesh> meshes;  // for their body ids
  const Camera& camera;
  const Camera& camera_before;
};

/// Traces and writes the pixels of a tile.
void write_seen(const SeenScene&, const Tile&, const SeenChannels&);

}  // namespace lagomorph::render::path
