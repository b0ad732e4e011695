#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/overlay/view.h"
#include "render/color.h"

namespace lagomorph::apps {

/// The edges of a surface, and its triangles, which hide what is behind them.
struct LineMesh {
  std::vector<render::Triangle> triangles;
  std::vector<std::array<std::uint32_t, 2>> edges;  // each once, in the order of the triangles
};
/// Lines along all edges of the triangles.
LineMesh line_mesh(std::vector<render::Triangle>);

struct LineStyle {
  Color color = {0, 0, 0};
  double width = 1.0;  // [pixels]; below 1 lines are fainter
  double opacity = 1.0;
  std::string hidden = "none";  // or "faint", "dashed", "all"
};

/// Whether an item is a triangle of the mesh, drawn from first_item on, that has the vertex.
View::IsOwn triangles_with(const LineMesh&, std::uint32_t vertex, int first_item);
/// The same of one that has both ends of the edge.
View::IsOwn triangles_at(const LineMesh&, const std::array<std::uint32_t, 2>& edge, int first_item);

/// Draws seen lines as two layers, the hidden ones below.
void draw_lines(render::Picture&, const SeenLines&, const LineStyle&);

/// Draws the edges of a mesh that is in the view's items from first_item on.
void draw_wireframe(render::Picture&, const View&, const LineMesh&, std::span<const render::Vec3> positions,
                    int first_item, const LineStyle&);

}  // namespace lagomorph::apps
