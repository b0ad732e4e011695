#include "apps/pipeline/body_lines.h"

#include <cmath>
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
  const bool fine = !scene.clip && !scene.body[body].surface.mesh.empty();
  return of == "surface" && fine ? lines_of_surface(surfaces[body]) : lines_of_tets(scene, model, body);
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
