#pragma once

#include <vector>

#include "apps/pipeline/motion.h"
#include "apps/progress/progress.h"
#include "apps/scene/scene_desc.h"
#include "render/render_scene.h"
#include "render/renderer.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// The model that a scene describes. Meshes are read, checked and placed; their sizes and remarks are told.
/// Throws sim::InputError.
sim::Model build_model(const SceneDesc&, Progress&);

/// The bodies of that model as they come from their files, not placed. Throws sim::InputError.
std::vector<sim::BodyInput> read_bodies(const SceneDesc&, Progress&);

/// What is drawn of each body: the boundary of its tets or the fine mesh that it carries. Throws
/// sim::InputError.
std::vector<sim::Surface> build_surfaces(const SceneDesc&, const sim::Model&, Progress&);

/// The same where no plane opens the bodies; where one does, the boundary of the tets that it leaves. Throws
/// sim::InputError, and Error(wrong_input) when nothing is left.
std::vector<sim::Surface> drawn_surfaces(const SceneDesc&, const sim::Model&, Progress&);

/// In single precision, as renderers take them.
std::vector<render::Vec3> to_render(const sim::Points&);
/// As renderers number vertices.
render::Triangle to_render(const sim::Triangle&);

/// Colours of a body's vertices where no field shows: its own, and the cut's.
std::vector<render::Color> plain_colors(const SceneDesc&, const sim::Surface&, std::size_t body);

/// What a renderer draws, the bodies at rest. A body without fill has no triangles.
render::RenderScene build_render_scene(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&);

/// Whether a picture needs the state before: of motion blur and motion vectors.
bool draws_motion(const SceneDesc&);

/// Moves the renderer's meshes to where the surfaces are at q; with `motion`, on its way to there.
void move_meshes(render::Renderer&, const std::vector<sim::Surface>&, const sim::VecX& q,
                 const Motion* motion = nullptr);

}  // namespace lagomorph::apps
