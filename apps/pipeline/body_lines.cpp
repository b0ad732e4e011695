#include "apps/pipeline/body_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "apps/pipeline/build_scene.h"
#include "sim/mesh_topology.h"

namespace lagomorph::apps {
namespace {

LineMesh boundary_lines(const sim::TetMesh& mesh, sim::Range tets) {
  const std::vector<sim::BoundaryFace> faces = sim::boundary_faces(mesh, tets);
  std::vector<render::Triangle> triangles;
  for (const sim::Triangle& t : sim::drawn_boundary(mesh, tets)) triangles.push_back(to_render(t));
  LineMesh lines = line_mesh(std::move(triangles));
  std::vector<bool> is_corner(static_cast<std::size_t>(mesh.vertex_count()));
  for (const sim::BoundaryFace& face : faces)
    for (const int corner : face.corners) is_corner[static_cast<std::size_t>(corner)] = true;
  std::erase_if(lines.edges, [&](const auto& edge) { return !is_corner[edge[0]] && !is_corner[edge[1]]; });
  return lines;
}

/// The pieces that coarse edges became; with `coarse`, whose vertices in use have the coarse numbers in their
/// order, of its edges alone.
std::vector<std::array<std::uint32_t, 2>> edges_in_pieces(const std::vector<std::array<int, 2>>& all,
                                                          std::size_t pieces, const LineMesh& coarse) {
  std::set<std::uint32_t> used;
  for (const render::Triangle& t : coarse.triangles) used.insert(t.begin(), t.end());
  const std::vector<std::uint32_t> vertices(used.begin(), used.end());
  const std::set<std::array<std::uint32_t, 2>> kept(coarse.edges.begin(), coarse.edges.end());
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (std::size_t i = 0; i < all.size(); i += pieces) {
    if (!kept.empty()) {
      const auto [a, b] = std::minmax(vertices[static_cast<std::size_t>(all[i][0])],
                                      vertices[static_cast<std::size_t>(all[i + pieces - 1][1])]);
      if (!kept.contains({a, b})) continue;
    }
    for (std::size_t k = i; k < i + pieces; ++k)
      edges.push_back({static_cast<std::uint32_t>(all[k][0]), static_cast<std::uint32_t>(all[k][1])});
  }
  return edges;
}

}  // namespace

BodyLines lines_of_all_tets(const sim::Model& model, std::size_t body) {
  return {boundary_lines(model.mesh(), model.mesh().bodies[body].tets), nullptr};
}

BodyLines lines_of_tets(const SceneDesc& scene, const sim::Model& model, std::size_t body) {
  if (!scene.clip) return lines_of_all_tets(model, body);
  const sim::TetMesh kept =
      sim::kept_part(model.mesh(), static_cast<int>(body), scene.clip->point, scene.clip->normal);
  return {boundary_lines(kept, {0, kept.tet_count()}), nullptr};
}

BodyLines lines_of(const SceneDesc& scene, const sim::Model& model, const std::vector<sim::Surface>& surfaces,
                   std::size_t body, const std::string& of) {
  const SurfaceDesc& drawn = scene.body[body].surface;
  const bool fine = !scene.clip && (!drawn.mesh.empty() || drawn.subdivide > 0);
  if (of != "surface" || !fine) return lines_of_tets(scene, model, body);
  BodyLines lines = lines_of_surface(surfaces[body]);
  if (drawn.subdivide > 0) {
    const bool of_tets = drawn.mesh.empty();
    lines.mesh.edges = edges_in_pieces(surfaces[body].coarse_edges(), std::size_t{1} << drawn.subdivide,
                                       of_tets ? lines_of_all_tets(model, body).mesh : LineMesh{});
  }
  return lines;
}

BodyLines lines_of_surface(const sim::Surface& surface) {
  std::vector<render::Triangle> triangles;
  triangles.reserve(surface.triangles().size());
  for (const sim::Triangle& t : surface.triangles()) triangles.push_back(to_render(t));
  return {line_mesh(std::move(triangles)), &surface};
}

std::vector<render::Vec3> positions_of(const BodyLines& lines, const sim::VecX& q) {
  return to_render(lines.surface != nullptr ? lines.surface->positions(q) : sim::Points(sim::as_points(q)));
}

Color srgb_color(const render::Color& linear) {
  Color color;
  for (int i = 0; i < 3; ++i)
    color[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::lround(255.0F * render::srgb_from_linear(linear[i])));
  return color;
}

}  // namespace lagomorph::apps
