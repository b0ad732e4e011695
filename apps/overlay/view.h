#pragma once

#include <functional>
#include <span>
#include <vector>

#include "apps/overlay/item_buffer.h"
#include "apps/overlay/strokes.h"
#include "render/render_scene.h"

/// Which parts of lines in the world a camera sees.
namespace lagomorph::apps {

/// Parts of lines in the picture, in the order of the lines.
struct SeenLines {
  std::vector<Segment> visible, hidden;
};

/// What stands between the camera and a point: triangles and the ground.
class View {
public:
  /// Items that lie on a line are not in its way.
  using IsOwn = std::function<bool(int item)>;

  View(const render::Camera&, const render::Ground&);

  const render::Camera& camera() const { return camera_; }
  ItemBuffer& items() { return items_; }
  const ItemBuffer& items() const { return items_; }

  /// Whether a point is seen: nothing that is not its own is nearer, or its own is seen within half a pixel,
  /// so that a line on a surface has no gaps where the surface is steep.
  bool sees(const ViewPoint&, const IsOwn& is_own = {}) const;
  bool sees(const render::Vec3& world, const IsOwn& is_own = {}) const;
  /// Adds what is in the picture of the line between two points.
  void add_line(const render::Vec3& a, const render::Vec3& b, const IsOwn& is_own, SeenLines&) const;

private:
  bool ground_hides(const ViewPoint&) const;

  render::Camera camera_;
  render::Ground ground_;
  ItemBuffer items_;
};

}  // namespace lagomorph::apps
