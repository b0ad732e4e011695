#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/pipeline/camera_rig.h"
#include "apps/pipeline/motion.h"
#include "apps/pipeline/overlays.h"
#include "apps/pipeline/surface_fields.h"
#include "apps/run/record.h"
#include "apps/scene/panels.h"
#include "apps/scene/scene_desc.h"
#include "render/color.h"
#include "render/renderer.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// What a picture shows of its scene: the camera, the fields and the overlays, of each panel where it has
/// some.
class Views {
public:
  /// All are referred to.
  Views(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&);

  /// Takes in a frame of the sequence, where need_all_states(). Positions q may be empty where they are not
  /// needed.
  void see(int frame, const StateRecord&, const sim::VecX& q);
  bool need_positions() const;
  /// What was found, a line each.
  std::vector<std::string> findings() const;
  /// Tells a picture's record what it was drawn with.
  void tell(PictureRecord&) const;
  /// Whether a picture was drawn with what is known now.
  bool drew(const PictureRecord&) const;

  /// What has no effect or is not all there, a line each.
  std::vector<std::string> remarks() const;

  /// Draws a frame whose bodies are, and in the renderer's scene already stand, at q; `motion` is how
  /// they came there, or nullptr.
  render::Image draw(render::Renderer&, render::FrameInfo, const sim::VecX& q,
                     const Motion* motion = nullptr) const;
  /// The picture of it: tone curve, overlays, colour bars, titles, caption. `told` is the state's record.
  render::Picture finish(const render::Image&, const sim::State&, const StateRecord& told) const;
  /// The camera, of the first panel where there are some.
  render::Camera camera(int frame, const sim::VecX& q) const { return camera(*views_.front(), frame, q); }

private:
  struct View {
    View(SceneDesc, const PanelPlace&, const sim::Model&, const std::vector<sim::Surface>&);
    SceneDesc scene;
    PanelPlace place;
    SurfaceFields fields;
    Overlays overlays;
    CameraRig rig;
  };

  std::map<std::string, std::array<double, 2>> ranges() const;
  std::optional<std::array<double, 6>> fitted_box() const;
  void color(render::Renderer&, const View&, const sim::VecX& q) const;
  double bar_strip() const;
  render::Camera camera(const View&, double frame, const sim::VecX& q) const;
  std::vector<render::Camera> shutter_cameras(const View&, int frame, const sim::VecX& q,
                                              const Motion&) const;
  render::Image draw(render::Renderer&, render::FrameInfo, const View&, const sim::VecX& q,
                     const Motion*) const;

  const SceneDesc& scene_;
  const std::vector<sim::Surface>& surfaces_;
  std::vector<std::unique_ptr<View>> views_;
};

/// Whether pictures of the scene need something that is found over its states.
bool need_all_states(const SceneDesc&);

}  // namespace lagomorph::apps
