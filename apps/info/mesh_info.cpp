#include <map>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/info/info.h"
#include "sim/mesh_check.h"
#include "sim/mesh_io.h"
#include "sim/mesh_topology.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

void add_tags(Report& report, const sim::TetMesh& mesh) {
  std::map<int, long long> tets_of;
  for (const int tag : mesh.tags) ++tets_of[tag];
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  std::string text;
  for (const auto& [tag, tets] : tets_of) {
    json[std::to_string(tag)] = tets;
    text += fmt::format("{}{} ({} tets)", text.empty() ? "" : ", ", tag, count_text(tets));
  }
  report.add("tags", text, "tags", json);
}

Report tet_mesh_report(const fs::path& file, const sim::TetMesh& mesh, const sim::Remarks& remarks) {
  const sim::TetMeshQuality q = sim::quality(mesh);
  Report report(file.string() + ": tetrahedral mesh", "tet mesh", file.string());
  report.add("vertices", count_text(mesh.vertex_count()), "vertices", mesh.vertex_count());
  report.add("tets", count_text(mesh.tet_count()), "tets", mesh.tet_count());
  if (!mesh.midsides.empty()) report.add("element", "quadratic, of 10 nodes", "element", "quadratic");
  report.add(
      "boundary",
      fmt::format("{} triangles, {}", count_text(q.boundary_triangles), q.closed ? "closed" : "not closed"),
      "boundary", {{"triangles", q.boundary_triangles}, {"closed", q.closed}});
  add_box(report, q.min, q.max);
  report.add("volume", number_text(q.volume) + " m^3", "volume", q.volume);
  report.add("dihedral angles",
             fmt::format("{} to {} degrees", number_text(q.min_dihedral_degrees),
                         number_text(q.max_dihedral_degrees)),
             "dihedral_degrees", {{"min", q.min_dihedral_degrees}, {"max", q.max_dihedral_degrees}});
  report.add("volume ratio", number_text(q.volume_ratio) + ", of the smallest to the largest tet",
             "volume_ratio", q.volume_ratio);
  report.add("radius ratio", number_text(q.worst_radius_ratio) + ", of the worst tet; the regular one has 1",
             "worst_radius_ratio", q.worst_radius_ratio);
  add_tags(report, mesh);
  add_remarks(report, remarks);
  return report;
}

std::string edges_text(const sim::SurfaceTopology& t) {
  std::string text = t.closed() ? "closed" : "not closed";
  if (t.open.count > 0) text += fmt::format(", {} open edges", count_text(t.open.count));
  if (t.crowded.count > 0)
    text += fmt::format(", {} edges of more than two triangles", count_text(t.crowded.count));
  if (t.inconsistent.count > 0) {
    text += fmt::format(", {} edges between opposite orientations", count_text(t.inconsistent.count));
  }
  if (t.crowded_vertices > 0)
    text += fmt::format(", {} vertices of several fans", count_text(t.crowded_vertices));
  return text;
}

}  // namespace

Report tet_mesh_info(const fs::path& file) {
  sim::Remarks remarks;
  const sim::TetMesh mesh = sim::read_tet_mesh(file, remarks);
  return tet_mesh_report(file, mesh, remarks);
}

Report tri_mesh_info(const fs::path& file) {
  sim::Remarks remarks;
  const sim::TriMesh mesh = sim::read_tri_mesh(file, remarks);
  const auto vertices = static_cast<int>(mesh.X.rows());
  const sim::SurfaceTopology topology = sim::surface_topology(mesh.triangles, vertices);
  Report report(file.string() + ": triangle mesh", "surface", file.string());
  report.add("vertices", count_text(vertices), "vertices", vertices);
  report.add("triangles", count_text(static_cast<long long>(mesh.triangles.size())), "triangles",
             mesh.triangles.size());
  add_box(report, mesh.X.colwise().minCoeff(), mesh.X.colwise().maxCoeff());
  report.add("surface", edges_text(topology), "surface",
             {{"closed", topology.closed()},
              {"open_edges", topology.open.count},
              {"crowded_edges", topology.crowded.count},
              {"inconsistent_edges", topology.inconsistent.count},
              {"crowded_vertices", topology.crowded_vertices}});
  add_remarks(report, remarks);
  return report;
}

Report mend_tet_mesh(const fs::path& file, const fs::path& mended) {
  const std::string extension = mended.extension().string();
  const std::vector<std::string> parts = sim::tet_mesh_parts(extension);  // known before anything is read
  sim::Remarks remarks;
  sim::TetMesh mesh = sim::read_tet_mesh(file, remarks, {.strays = false});
  const int dropped = sim::drop_stray_vertices(mesh);
  for (const std::string& part : parts) {
    write_file(fs::path(mended).replace_extension(part), sim::write_tet_mesh(mesh, part));
  }
  Report report = tet_mesh_report(mended, mesh, remarks);
  report.add("mended",
             fmt::format("{} stray {} of {} dropped", count_text(dropped),
                         dropped == 1 ? "vertex" : "vertices", file.string()),
             "dropped", dropped);
  return report;
}

}  // namespace lagomorph::apps
