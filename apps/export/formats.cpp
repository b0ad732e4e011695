#include "apps/export/formats.h"

#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/export/gltf.h"
#include "apps/export/look_remarks.h"
#include "apps/export/obj.h"
#include "apps/export/usd.h"
#include "apps/pipeline/surface_fields.h"
#include "sim/io/field_writers.h"
#include "sim/io/formats.h"

namespace lagomorph::apps {
namespace {

/// Vertices that a pin holds, in some axis at least, when the state is reached.
std::vector<std::uint8_t> pinned(const sim::Model& model, double t) {
  std::vector<std::uint8_t> flags(static_cast<std::size_t>(model.mesh().vertex_count()), 0);
  for (const int v : model.held(t).pins().vertices()) flags[static_cast<std::size_t>(v)] = 1;
  return flags;
}

/// With the state's vectors, whatever the fields; of displacement the vector alone.
std::string vtu(const ExportedScene& scene, const sim::State& state) {
  sim::TetMesh mesh = scene.model.mesh();
  const sim::VecX moved = state.q - sim::as_q(mesh.X);
  mesh.X = sim::as_points(state.q);
  std::vector<std::string> scalars = scene.fields;
  std::erase(scalars, "displacement");
  return sim::io::write_vtu(mesh, sim::fields_of(scene.model, state.q, scalars),
                            {{"displacement", moved}, {"velocity", state.qdot}},
                            {{"pinned", pinned(scene.model, state.t)}});
}

/// The surfaces of all bodies, one after the other.
sim::TriMesh surface_mesh(const ExportedScene& scene, const sim::VecX& q) {
  sim::TriMesh all;
  for (const sim::Surface& surface : scene.surfaces) {
    const int first = static_cast<int>(all.X.rows());
    all.X.conservativeResize(first + surface.vertex_count(), 3);
    all.X.bottomRows(surface.vertex_count()) = surface.positions(q);
    for (const sim::Triangle& t : surface.triangles())
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

std::string ply(const ExportedScene& scene, const sim::State& state) {
  std::vector<sim::Field> fields;
  if (!scene.fields.empty()) fields = sim::fields_of(scene.model, state.q, scene.fields);
  for (sim::Field& field : fields) {
    std::vector<double> all;
    for (const sim::Surface& surface : scene.surfaces) {
      const std::vector<double> values = surface_values(surface, field.vertices);
      all.insert(all.end(), values.begin(), values.end());
    }
    field.vertices = std::move(all);
  }
  return sim::io::write_ply(surface_mesh(scene, state.q), fields);
}

/// The explicit table: a new format is one row.
constexpr ExportFormat formats[] = {
    {"vtu", ".vtu", true, true, false, vtu, nullptr, nullptr},
    {"ply", ".ply", true, false, false, ply, nullptr, nullptr},
    {"obj", ".obj", false, false, false, write_obj_frame, nullptr, obj_remarks},
    {"gltf", ".glb", false, false, true, nullptr, write_gltf, gltf_remarks},
    {"usda", ".usda", true, false, false, nullptr, write_usd, usd_remarks}};

}  // namespace

bool ExportedSequence::each(const std::function<void(const sim::State&)>& visit) const {
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    if (stop()) return false;
    visit(state(frame));
    told();
  }
  return true;
}

const ExportFormat& find_format(std::string_view name) {
  std::string names;
  for (const ExportFormat& format : formats) {
    if (name == format.name) return format;
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  wrong_input(fmt::format("--format {}: unknown; known are {}", name, names));
}

}  // namespace lagomorph::apps
