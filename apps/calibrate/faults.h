#pragma once

#include <string>
#include <vector>

#include "render/camera.h"
#include "render/color.h"
#include "render/render_scene.h"

/// Known faults, for finding out what a check must see.
namespace lagomorph::apps {

struct PictureChange {
  const char* name;
  bool harmless;
  render::Picture (*apply)(const render::Picture&);
};
/// Of 8-bit samples: rounding by 1, a shift of 1 pixel, red times 1.1, gamma 1.1.
const std::vector<PictureChange>& picture_changes();

/// Part of a mesh: the vertices within `radius` of the one that is nearest to the camera inside of the
/// picture.
struct Cluster {
  std::size_t mesh = 0;
  render::Vec3 center;  // [m]
  float radius = 0;     // an eighth of the diagonal of the mesh's bounding box [m]
};
/// Meshes at their positions of the frame. Throws Error(wrong_input) when none is in the picture.
Cluster visible_cluster(const std::vector<render::Mesh>&, const render::Camera&, int frame);

/// The mesh without the triangles that have a vertex in the cluster.
void remove_cluster(render::Mesh&, const Cluster&);
/// Its vertices pushed aside by up to half the radius, smoothly to none at its rim.
void move_cluster(render::Mesh&, const Cluster&, const render::Camera&);

}  // namespace lagomorph::apps
