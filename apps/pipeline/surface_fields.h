#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "apps/overlay/color_bar.h"
#include "apps/scene/scene_desc.h"
#include "render/colormap.h"
#include "render/renderer.h"
#include "sim/fields.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// Values of the tets' vertices on a surface, carried as a coordinate is.
std::vector<double> surface_values(const sim::Surface&, const std::vector<double>& vertices);

/// The colour map that a body's field is shown in; of auto the field's own.
const render::Colormap& colormap_of(const ShownField&);

/// The scalar fields that a scene shows on its bodies. Bodies that show the same field in the same colours
/// share an automatic range.
class SurfaceFields {
public:
  /// All are referred to.
  SurfaceFields(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&);

  bool is_empty() const { return scales_.empty(); }
  /// Whether a range is to be found by see().
  bool is_automatic() const;
  /// Widens the automatic ranges by what a state shows at positions q. Values that are not finite are left
  /// out.
  void see(const sim::VecX& q);

  /// What is told in the pictures: each range once, as it is now; with its bodies' names where there are
  /// others.
  std::vector<ColorBar> bars() const;
  /// Those of a picture of positions q: with whether it shows values beyond a given range.
  std::vector<ColorBar> bars(const sim::VecX& q) const;
  /// The ranges in use, by the body's name.
  std::map<std::string, std::array<double, 2>> ranges() const;
  /// Gives the renderer's meshes the colours of positions q.
  void color_meshes(render::Renderer&, const sim::VecX& q) const;
  /// How much of its range a body shows at positions q, 0 to 1; the most of all bodies.
  double spread(const sim::VecX& q) const;
  /// The colours of each body's surface; none of a body that shows no field.
  std::vector<std::vector<render::Color>> colors(const sim::VecX& q) const;

private:
  struct Scale {
    sim::FieldInfo field;
    const render::Colormap* map;
    bool automatic, bar;
    double low, high;  // low > high: nothing was seen yet
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  static std::array<double, 2> range_of(const Scale&);
  /// Those of the bodies that have it.
  std::string names_of(std::size_t scale) const;
  std::vector<Category> bodies_of(std::size_t scale) const;
  /// Calls with a body, its scale and the values on its surface.
  void for_values(const sim::VecX& q, const auto& visit) const;

  const SceneDesc& scene_;
  const sim::Model& model_;
  const std::vector<sim::Surface>& surfaces_;
  std::vector<Scale> scales_;
  std::vector<std::size_t> scale_of_body_;  // or none
  std::vector<std::string> names_;          // of the fields, each once
};

/// Whether pictures of the scene need a range that is found over its states.
bool has_automatic_range(const SceneDesc&);

}  // namespace lagomorph::apps
