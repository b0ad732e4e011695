#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "apps/overlay/color_bar.h"
#include "apps/overlay/energy_plot.h"
#include "apps/overlay/view.h"
#include "apps/pipeline/body_lines.h"
#include "apps/pipeline/glyphs.h"
#include "apps/pipeline/labels.h"
#include "apps/run/record.h"
#include "apps/scene/scene_desc.h"
#include "render/camera.h"
#include "render/color.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// Lines and signs that a scene draws over its pictures, in the world and hidden by what is in front of them,
/// and the diagram of its energies. Back ends have no part in them. Drawing is safe from many threads.
class Overlays {
public:
  /// All are referred to; surfaces are those that are drawn.
  Overlays(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&);

  /// Takes a frame of the sequence into the diagram and its axes, and the largest displacement. Positions q
  /// are not needed unless needs_positions().
  void see(int frame, const StateRecord&, const sim::VecX& q);
  bool needs_positions() const { return scene_.glyphs.displacement_every > 0; }
  /// What the pictures depend on beside the state, by names that are no body's.
  std::map<std::string, std::array<double, 2>> ranges() const;

  /// Draws those of a state over its picture.
  void draw(render::Picture&, const render::Camera&, const sim::State&) const;
  /// Draws the diagram of the energies up to a frame where the layout has room.
  void draw_energies(render::Picture&, OverlayLayout&, int frame) const;
  /// Of displacements, where they have arrows.
  std::vector<ColorBar> bars() const;

  /// What of the scene's overlays has no effect or is not all there, a line each.
  std::vector<std::string> remarks() const;

private:
  bool has_any_in_world() const;
  /// Light goes through it, straight on. What is clear bends it: behind a clear body nothing is where it
  /// seems.
  bool is_see_through(std::size_t body) const {
    return scene_.body[body].surface.fill && scene_.body[body].look.opacity < 1.0F;
  }
  bool hides(std::size_t body, bool see_through_hide) const {
    return see_through_hide || !is_see_through(body);
  }
  bool shows_face_orientations() const;
  /// Everything that a renderer draws and that hides what is behind it: see-through bodies as asked for.
  View view_of(const render::Camera&, const sim::VecX& q, bool see_through_hide) const;
  void draw_in_world(render::Picture&, const render::Camera&, const sim::State&, bool see_through_hide) const;
  /// How much of what is behind see-through bodies is seen in each pixel: what the nearest lets through.
  std::vector<float> seen_through(const render::Camera&, const sim::VecX& q) const;
  /// Outsides blue, insides red, as much as they are seen: through see-through bodies, too.
  void draw_face_orientations(render::Picture&, const render::Camera&, const sim::VecX& q) const;
  void draw_ghosts(render::Picture&, const View&) const;
  void draw_wireframes(render::Picture&, const View&, const sim::VecX& q, bool see_through_hide) const;
  void draw_labels(render::Picture&, const View&, const sim::VecX& q) const;

  const SceneDesc& scene_;
  const sim::Model& model_;
  std::vector<BodyLines> drawn_;       // a body each; empty where it has no fill
  std::vector<BodyLines> wireframes_;  // likewise; empty where none is shown
  std::vector<BodyLines> ghosts_;      // likewise
  std::vector<Labels> labels_;         // likewise
  Glyphs glyphs_;
  std::map<int, EnergySample> energies_;  // by frame
  EnergyAxes axes_;
  double most_ = 0.0;  // displacement [m]
};

/// Whether pictures of the scene need what is found over its states.
bool needs_sequence(const SceneDesc&);

}  // namespace lagomorph::apps
