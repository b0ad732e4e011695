#pragma once

#include <functional>
#include <vector>

#include "apps/overlay/view.h"
#include "apps/pipeline/body_lines.h"
#include "apps/scene/scene_desc.h"
#include "render/color.h"
#include "render/colormap.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// Signs of what holds, pulls and moves the bodies of a scene.
class Glyphs {
public:
  /// All are referred to; surfaces are those that are drawn.
  Glyphs(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&);

  bool is_empty() const;
  /// `things` is what the scene draws; the tets' boundaries of bodies that hide stand in the way of what is
  /// on them, too. Arrows of displacements have the last colour at `most` [m].
  void draw(render::Picture&, const View& things, const sim::State&, double most,
            const std::function<bool(std::size_t body)>& hides) const;
  /// The largest displacement that has an arrow at positions q. [m]
  double largest_displacement(const sim::VecX& q) const;

  /// The length of markers, where the scene gives none: 1/55 of the diagonal of all bodies at rest. [m]
  double size() const { return size_; }
  /// The force whose arrow is a metre long, where the scene gives none: the largest of all times has 0.22 of
  /// the diagonal. [N]
  double force() const { return force_; }

private:
  void draw_pins(render::Picture&, const View&, const sim::State&) const;
  void draw_loads(render::Picture&, const View&, const sim::State&) const;
  void draw_gravity(render::Picture&, const View&, const sim::State&) const;
  void draw_displacements(render::Picture&, const View&, const sim::VecX& q, double most) const;
  /// Calls with the rest and the present position of each vertex that has an arrow.
  void for_displacements(const sim::VecX& q, const auto& visit) const;
  bool sees_vertex(const View&, std::size_t body, std::uint32_t node,
                   const std::vector<render::Vec3>& positions) const;

  const SceneDesc& scene_;
  const sim::Model& model_;
  const std::vector<sim::Surface>& surfaces_;
  std::vector<BodyLines> tets_;          // a body each
  std::vector<std::vector<bool>> skin_;  // likewise: whether a node is on the boundary
  double size_ = 0.02, force_ = 1.0;
};

}  // namespace lagomorph::apps
