#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/overlay/overlay.h"
#include "apps/overlay/view.h"
#include "apps/pipeline/body_lines.h"
#include "apps/scene/scene_desc.h"
#include "render/color.h"
#include "sim/model.h"
#include "sim/surface.h"

namespace lagomorph::apps {

/// Numbers of a body's vertices and faces, as of its files and selectors, where they are seen and have room.
class Labels {
public:
  Labels() = default;  // none
  Labels(const SceneDesc&, const sim::Model&, const std::vector<sim::Surface>&, std::size_t body);

  bool is_empty() const { return every_vertex_ == 0 && every_face_ == 0; }
  const BodyLines& lines() const { return lines_; }
  /// The view has the triangles of lines() from first_item on. A number without room beside those that have
  /// `taken` theirs is left out.
  void draw(render::Picture&, const View&, const std::vector<render::Vec3>& positions, int first_item,
            std::vector<Rectangle>& taken) const;
  /// Which of them have numbers, where it is not all.
  std::optional<std::string> remark(const std::string& body) const;

private:
  BodyLines lines_;
  int first_vertex_ = 0;                   // whose number is 0
  std::vector<std::uint32_t> vertices_;    // of the triangles, ascending
  int every_vertex_ = 0, every_face_ = 0;  // 0: none
};

}  // namespace lagomorph::apps
