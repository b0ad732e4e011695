#include "apps/overlay/ghost.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "apps/overlay/overlay.h"

namespace lagomorph::apps {
namespace {

using render::Vec3;

std::vector<Vec3> normals_of(const LineMesh& mesh, std::span<const Vec3> x) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles)
    normals.push_back((x[j] - x[i]).cross(x[k] - x[i]).normalized());
  return normals;
}

Vec3 towards_eye(const render::Camera& camera, const Vec3& at) {
  return camera.is_orthographic() ? Vec3(-camera.forward()) : Vec3((camera.position() - at).normalized());
}

/// At either end of the edge: a contour that goes to and fro from edge to edge has no gaps where its
/// neighbours hide it.
View::IsOwn triangles_around(const LineMesh& mesh, const std::array<std::uint32_t, 2>& edge, int first_item) {
  return [a = triangles_with(mesh, edge[0], first_item),
          b = triangles_with(mesh, edge[1], first_item)](int item) { return a(item) || b(item); };
}

/// How much of each pixel the ghost covers, times how it is seen there.
void fill(render::Picture& picture, const View& things, const ItemBuffer& ghost, const LineMesh& mesh,
          std::span<const Vec3> x, const GhostStyle& style) {
  const std::vector<Vec3> normals = normals_of(mesh, x);
  std::vector<float> strength;  // of each triangle: most where it is seen from the side
  for (std::size_t t = 0; t < normals.size(); ++t) {
    const float facing = std::abs(normals[t].dot(towards_eye(things.camera(), x[mesh.triangles[t][0]])));
    strength.push_back(0.4F + 0.6F * (1.0F - facing));
  }
  constexpr int n = ItemBuffer::samples;
  for (int y = 0; y < picture.height; ++y) {
    for (int column = 0; column < picture.width; ++column) {
      double sum = 0.0;
      for (int i = 0; i < n * n; ++i) {
        const int c = n * column + i % n, r = n * y + i / n;
        const int item = ghost.item(c, r);
        if (item == ItemBuffer::none) continue;
        const double depth = ghost.depth(c, r);
        const ViewPoint at{(c + 0.5) / n, (r + 0.5) / n, depth};
        // On a thing, as all of it is at rest, the ghost is not seen.
        const double slack = 2.0 * static_cast<double>(things.camera().pixel_size(static_cast<float>(depth)));
        if (!style.over && (!things.sees(at) || std::abs(things.items().depth(c, r) - depth) < slack))
          continue;
        sum += static_cast<double>(strength[static_cast<std::size_t>(item)]);
      }
      if (sum != 0.0) blend(picture, column, y, style.color, style.opacity * sum / (n * n));
    }
  }
}

/// Edges of a surface that were drawn into a picture, and what is seen of them.
struct SeenEdge {
  std::array<std::uint32_t, 2> ends;
  SeenLines lines;

  double length() const {
    double sum = 0.0;
    for (const Segment& s : lines.visible) sum += std::hypot(s.b.x - s.a.x, s.b.y - s.a.y);
    return sum;
  }
};

/// The visible parts but for crumbs: where a rough surface is nearly seen from the side, a few edges turn
/// away from the eye by themselves. Such are chains of edges that are together shorter than a small part of
/// all.
SeenLines without_crumbs(const std::vector<SeenEdge>& edges, std::size_t vertex_count) {
  constexpr double crumb = 0.03;
  std::vector<std::size_t> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  double all = 0.0;
  for (const SeenEdge& edge : edges) {
    if (edge.lines.visible.empty()) continue;
    all += edge.length();
    parent[root(edge.ends[0])] = root(edge.ends[1]);
  }
  std::vector<double> lengths(vertex_count);
  for (const SeenEdge& edge : edges) lengths[root(edge.ends[0])] += edge.length();
  SeenLines kept;
  for (const SeenEdge& edge : edges) {
    if (lengths[root(edge.ends[0])] < crumb * all) continue;
    kept.visible.insert(kept.visible.end(), edge.lines.visible.begin(), edge.lines.visible.end());
  }
  return kept;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> contours(const LineMesh& mesh, std::span<const Vec3> x,
                                                   const render::Camera& camera) {
  const std::vector<Vec3> normals = normals_of(mesh, x);
  const float sharp = std::cos(50.0F * 3.14159265F / 180.0F);
  std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>> around;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      around[{a, b}].push_back(t);
    }
  }
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto& edge : mesh.edges) {
    const std::vector<std::size_t>& triangles = around[edge];
    bool shown = triangles.size() != 2;
    if (!shown) {
      const Vec3 &m = normals[triangles[0]], &n = normals[triangles[1]];
      const Vec3 eye = towards_eye(camera, x[edge[0]]);
      shown = m.dot(n) < sharp || (m.dot(eye) > 0.0F) != (n.dot(eye) > 0.0F);
    }
    if (shown) edges.push_back(edge);
  }
  return edges;
}

void draw_ghost(render::Picture& picture, const View& things, const LineMesh& mesh, std::span<const Vec3> x,
                const GhostStyle& style) {
  ItemBuffer ghost(things.camera());
  ghost.draw(mesh.triangles, x);
  if (style.fill) fill(picture, things, ghost, mesh, x, style);
  if (!style.outline) return;
  constexpr int own = 1 << 30;
  const render::Ground none{.enabled = false};
  View view = style.over ? View(things.camera(), none) : things;
  view.items().draw(mesh.triangles, x, own);
  std::vector<SeenEdge> edges;
  for (const auto& edge : contours(mesh, x, things.camera()))
    view.add_line(x[edge[0]], x[edge[1]], triangles_around(mesh, edge, own),
                  edges.emplace_back(SeenEdge{edge, {}}).lines);
  draw_lines(picture, without_crumbs(edges, x.size()),
             {.color = style.color, .width = 1.4, .opacity = 0.9, .hidden = "none"});
}

}  // namespace lagomorph::apps
