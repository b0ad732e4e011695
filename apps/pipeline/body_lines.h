#pragma once

#include <string>
#include <vector>

#include "apps/overlay/wireframe.h"
#include "apps/scene/scene_desc.h"
#include "render/color.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// The triangles and edges of a body that lines and signs are on, and what moves them.
struct BodyLines {
  LineMesh mesh;
  const sim::Surface* surface = nullptr;  // none: vertices are the nodes of all tets
};

/// The boundary of all tets of a body.
BodyLines lines_of_all_tets(const sim::Model&, std::size_t body);
/// The same of those that a clip leaves. Of quadratic tets only the tets' own edges,
/// not those between the four triangles of a face.
BodyLines lines_of_tets(const SceneDesc&, const sim::Model&, std::size_t body);
/// Of "surface" what is drawn of the body, the boundary of its tets unless it is a fine mesh or subdivided;
/// the edges are then those of what was subdivided, as they run on it. Of "tets" that boundary.
BodyLines lines_of(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&, std::size_t body,
                   const std::string& of);
BodyLines lines_of_surface(const sim::Surface&);

std::vector<render::Vec3> positions_of(const BodyLines&, const sim::VecX& q);

/// Items of a body's own triangles in a view: beyond those of the scene, a range for each body.
inline int own_items(std::size_t body) { return (1 << 28) + (static_cast<int>(body) << 22); }

/// A linear colour in 8 bits.
Color srgb_color(const render::Color& linear);

}  // namespace lagomorph::apps
