#include "apps/overlay/wireframe.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace lagomorph::apps {
namespace {

constexpr double faint_share = 0.28;  // of the opacity of what is seen

/// nullptr where the item is none of the mesh's.
const render::Triangle* triangle_of(const LineMesh& mesh, int item, int first_item) {
  const auto i = static_cast<std::size_t>(item - first_item);
  return item >= first_item && i < mesh.triangles.size() ? &mesh.triangles[i] : nullptr;
}

bool has(const render::Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

/// Each line with gaps.
std::vector<Segment> with_gaps(const std::vector<Segment>& lines, double on, double off) {
  std::vector<Segment> dashes;
  for (const Segment& s : lines) {
    const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, length = std::hypot(dx, dy);
    const int count = static_cast<int>(std::ceil(length / (on + off)));
    for (int i = 0; i < count; ++i) {
      const double at = i * (on + off), from = at / length, to = std::min(at + on, length) / length;
      dashes.push_back({{s.a.x + from * dx, s.a.y + from * dy}, {s.a.x + to * dx, s.a.y + to * dy}});
    }
  }
  return dashes;
}

}  // namespace

LineMesh line_mesh(std::vector<render::Triangle> triangles) {
  LineMesh mesh{std::move(triangles), {}};
  std::set<std::array<std::uint32_t, 2>> known;
  for (const render::Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      if (known.insert({a, b}).second) mesh.edges.push_back({a, b});
    }
  }
  return mesh;
}

View::IsOwn triangles_with(const LineMesh& mesh, std::uint32_t vertex, int first_item) {
  return [&mesh, vertex, first_item](int item) {
    const render::Triangle* const t = triangle_of(mesh, item, first_item);
    return t != nullptr && has(*t, vertex);
  };
}

View::IsOwn triangles_at(const LineMesh& mesh, const std::array<std::uint32_t, 2>& edge, int first_item) {
  return [&mesh, edge, first_item](int item) {
    const render::Triangle* const t = triangle_of(mesh, item, first_item);
    return t != nullptr && has(*t, edge[0]) && has(*t, edge[1]);
  };
}

void draw_lines(render::Picture& picture, const SeenLines& lines, const LineStyle& style) {
  const double opacity = style.opacity * std::min(1.0, style.width);
  std::vector<Segment> solid = lines.visible;
  if (style.hidden == "all") solid.insert(solid.end(), lines.hidden.begin(), lines.hidden.end());
  if (style.hidden == "faint")
    draw_strokes(picture, lines.hidden, style.width, style.color, faint_share * opacity);
  if (style.hidden == "dashed") {
    const double unit = std::max(1.0, style.width);
    draw_strokes(picture, with_gaps(lines.hidden, 3.0 * unit, 4.0 * unit), style.width, style.color,
                 0.6 * opacity);
  }
  draw_strokes(picture, solid, style.width, style.color, opacity);
}

void draw_wireframe(render::Picture& picture, const View& view, const LineMesh& mesh,
                    std::span<const render::Vec3> positions, int first_item, const LineStyle& style) {
  SeenLines lines;
  for (const auto& edge : mesh.edges)
    view.add_line(positions[edge[0]], positions[edge[1]], triangles_at(mesh, edge, first_item), lines);
  draw_lines(picture, lines, style);
}

}  // namespace lagomorph::apps
