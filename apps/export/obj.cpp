// Wavefront OBJ and MTL (Wavefront, "Advanced Visualizer" manual, appendix B1), with the physically based
// extension of MTL [Exocortex 2013], which Blender reads.
#include "apps/export/obj.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "apps/export/moving_mesh.h"
#include "apps/version.h"
#include "render/albedo.h"
#include "sim/io/text_writer.h"

namespace lagomorph::apps {
namespace {

/// Names end at a blank for some readers, and # begins a comment.
std::string one_word(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0 || c == '#'; }, '_');
  return name;
}

/// Of objects and materials, each its own.
std::vector<std::string> obj_names(const sim::TetMesh& mesh) {
  std::vector<std::string> names;
  for (const sim::Body& body : mesh.bodies) {
    const std::string stem = one_word(body.name);
    std::string name = stem;
    for (int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n)
      name = fmt::format("{}_{}", stem, n);
    names.push_back(std::move(name));
  }
  return names;
}

std::string rgb(const render::Color& c) { return fmt::format("{:.6g} {:.6g} {:.6g}", c.x(), c.y(), c.z()); }

/// Blender's reading of the classic keys: Ns = 1000 (1 - roughness)^2, Ks its Specular, where 0.5 is an
/// index of 1.5, and with a mirror (illum 3, 6) Ka how much of a metal it is.
std::string material_entry(const std::string& name, const render::Material& look) {
  const float specular = std::min(render::dielectric_f0(look) / 0.08F, 1.0F);
  const float smooth = 1.0F - look.roughness;
  const bool is_metal = look.metallic > 0.0F, is_thin = look.opacity < 1.0F;
  const int model = is_metal ? (is_thin ? 6 : 3) : (is_thin ? 9 : 2);
  std::string text = "\nnewmtl " + name + "\n";
  text += "Ns " + fmt::format("{:.6g}\n", 1000.0F * smooth * smooth);
  text += "Ka " + rgb(render::Color::Constant(is_metal ? look.metallic : 1.0F)) + "\n";
  text += "Kd " + rgb(render::albedo(look)) + "\n";
  text += "Ks " + rgb(render::Color::Constant(specular)) + "\n";
  text += fmt::format("Ni {}\nd {}\nillum {}\n", look.ior, look.opacity, model);
  text += fmt::format("Pr {}\nPm {}\n", look.roughness, look.metallic);
  if (look.sheen > 0.0F) text += fmt::format("Ps {}\n", look.sheen);
  if (look.coat > 0.0F) text += fmt::format("Pc {}\nPcr {}\n", look.coat, look.coat_roughness);
  return text;
}

}  // namespace

std::string write_obj_frame(const ExportedScene& scene, const sim::State& state) {
  const std::vector<std::string> names = obj_names(scene.model.mesh());
  const std::vector<MovingMesh> meshes = moving_meshes(scene);
  sim::io::TextWriter out;
  out << "# Lagomorph " << version() << "\nmtllib " << obj_library_name(scene.desc) << '\n';
  std::size_t first = 1, first_normal = 1;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const MovingMesh& mesh = meshes[i];
    out << "o " << names[i] << '\n';
    const sim::Points X = mesh.surface().positions(state.q);
    for (Eigen::Index v = 0; v < X.rows(); ++v) {
      out << "v ";
      out.line(X(v, 0), X(v, 1), X(v, 2));
    }
    if (mesh.has_normals()) {
      std::string normals;
      for (const render::Vec3& n : mesh.normals(mesh.positions(state.q)))
        fmt::format_to(std::back_inserter(normals), "vn {} {} {}\n", n.x(), n.y(), n.z());
      out << normals;
    }
    out << "usemtl " << names[i] << (mesh.has_normals() ? "\ns 1\n" : "\ns off\n");
    for (const render::Triangle& t : mesh.triangles()) {
      out << 'f';
      for (const auto corner : t) {
        out << ' ' << first + corner;
        if (mesh.has_normals()) out << "//" << first_normal + corner;
      }
      out << '\n';
    }
    first += mesh.vertex_count();
    if (mesh.has_normals()) first_normal += mesh.vertex_count();
  }
  return out.take();
}

std::string obj_library_name(const SceneDesc& scene) { return one_word(scene.name) + ".mtl"; }

std::string obj_library(const ExportedScene& scene) {
  const std::vector<std::string> names = obj_names(scene.model.mesh());
  std::string text = "# Lagomorph " + std::string(version()) + "\n";
  for (std::size_t i = 0; i < names.size(); ++i) text += material_entry(names[i], scene.desc.body[i].look);
  return text;
}

}  // namespace lagomorph::apps
