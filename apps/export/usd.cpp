#include "apps/export/usd.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "apps/export/moving_mesh.h"
#include "apps/file_io.h"
#include "apps/pipeline/surface_fields.h"
#include "apps/version.h"

namespace lagomorph::apps {
namespace {

std::string text_of(const render::Vec3& v) { return fmt::format("({}, {}, {})", v.x(), v.y(), v.z()); }

/// [a, b, c]
template <class Values, class Text>
std::string list_of(const Values& values, Text text) {
  std::string list = "[";
  for (const auto& value : values) {
    if (list.size() > 1) list += ", ";
    list += text(value);
  }
  return list + "]";
}

class Writer {
public:
  Writer(const ExportedSequence& sequence, const std::filesystem::path& file)
      : sequence_(sequence), meshes_(moving_meshes(sequence.scene)), out_(file) {
    std::vector<std::string> names = {"materials", "camera"};  // siblings of the bodies
    for (const MovingMesh& mesh : meshes_) names.push_back(mesh.name());
    names_ = prim_names(names);
    names_.erase(names_.begin(), names_.begin() + 2);
    root_ = prim_names({sequence.scene.desc.name}).front();
  }

  bool write() {
    int passes = 0;
    for (const MovingMesh& mesh : meshes_)
      passes += (mesh.has_normals() ? 2 : 1) + static_cast<int>(sequence_.scene.fields.size());
    sequence_.begin(passes);
    write_head();
    for (std::size_t i = 0; i < meshes_.size(); ++i)
      if (!write_mesh(i)) return false;
    out_.write("}\n");
    out_.finish();
    return true;
  }

private:
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    out_.write(fmt::format(format, std::forward<Values>(values)...) + "\n");
  }

  void write_head() {
    const SceneDesc& desc = sequence_.scene.desc;
    line("#usda 1.0\n(\n    defaultPrim = \"{}\"\n    doc = \"Lagomorph {}\"", root_, version());
    line("    startTimeCode = {}\n    endTimeCode = {}", sequence_.frames.first, sequence_.frames.last);
    line("    timeCodesPerSecond = {0}\n    framesPerSecond = {0}", desc.time.fps);
    line("    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n");
    line("def Xform \"{}\"\n{{", root_);
    write_camera(desc);
    line("    def Scope \"materials\"\n    {{");
    for (std::size_t i = 0; i < meshes_.size(); ++i) write_material(i);
    line("    }}\n");
  }

  /// Apertures and focal length are in tenths of a unit; that of a perspective is as of a film 24 mm high.
  void write_camera(const SceneDesc& desc) {
    const render::CameraSettings& settings = sequence_.scene.camera;
    const render::Camera camera(settings, desc.render.width, desc.render.height);
    const double aspect = static_cast<double>(desc.render.width) / desc.render.height;
    const double height = settings.orthographic ? 10.0 * *settings.orthographic : 24.0;
    const render::Vec3 back = -camera.forward();
    const auto row = [](const render::Vec3& v, int last) {
      return fmt::format("({}, {}, {}, {})", v.x(), v.y(), v.z(), last);
    };
    line("    def Camera \"camera\"\n    {{");
    line("        float2 clippingRange = ({}, {})", kNear * view_scale(settings),
         kFar * view_scale(settings));
    if (!settings.orthographic)
      line("        float focalLength = {}",
           static_cast<float>(height / 2 / std::tan(settings.fov * std::numbers::pi / 360)));
    line("        float horizontalAperture = {}", static_cast<float>(height * aspect));
    line("        float verticalAperture = {}", static_cast<float>(height));
    line("        token projection = \"{}\"", settings.orthographic ? "orthographic" : "perspective");
    line("        matrix4d xformOp:transform = ( {}, {}, {}, {} )", row(camera.right(), 0),
         row(camera.up(), 0), row(back, 0), row(camera.position(), 1));
    line("        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }}\n");
  }

  std::string material_path(std::size_t body) const {
    return fmt::format("/{}/materials/{}", root_, names_[body]);
  }

  void write_material(std::size_t body) {
    const render::Material& look = meshes_[body].look();
    line("        def Material \"{}\"\n        {{", names_[body]);
    line("            token outputs:surface.connect = <{}/surface.outputs:surface>\n", material_path(body));
    line("            def Shader \"surface\"\n            {{");
    line("                uniform token info:id = \"UsdPreviewSurface\"");
    line("                color3f inputs:diffuseColor = {}", text_of(look.base_color.matrix()));
    line("                float inputs:metallic = {}", look.metallic);
    line("                float inputs:roughness = {}", look.roughness);
    line("                float inputs:ior = {}", look.ior);
    line("                token outputs:surface\n            }}\n        }}");
  }

  /// An attribute by time, a pass over the states.
  template <class Text>
  bool write_samples(const std::string& attribute, Text text) {
    line("        {}.timeSamples = {{", attribute);
    const bool all = sequence_.each([&](const sim::State& state) {
      out_.write(fmt::format("            {}: ", state.frame));
      out_.write(text(state));
      out_.write(",\n");
    });
    line("        }}");
    return all;
  }

  bool write_mesh(std::size_t body) {
    const MovingMesh& mesh = meshes_[body];
    line("    def Mesh \"{}\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {{",
         names_[body]);
    line("        uniform bool doubleSided = 1");
    line("        int[] faceVertexCounts = {}",
         list_of(mesh.triangles(), [](const render::Triangle&) { return "3"; }));
    line("        int[] faceVertexIndices = {}", list_of(mesh.triangles(), [](const render::Triangle& t) {
           return fmt::format("{}, {}, {}", t[0], t[1], t[2]);
         }));
    line("        rel material:binding = <{}>", material_path(body));
    line("        uniform token subdivisionScheme = \"none\"");
    std::string extents;
    const bool points = write_samples("point3f[] points", [&](const sim::State& state) {
      const std::vector<render::Vec3> x = mesh.positions(state.q);
      const Extent extent = extent_of(x);
      extents +=
          fmt::format("            {}: [{}, {}],\n", state.frame, text_of(extent.min), text_of(extent.max));
      return list_of(x, text_of);
    });
    if (!points) return false;
    line("        float3[] extent.timeSamples = {{\n{}        }}", extents);
    if (mesh.has_normals()) {
      line("        normal3f[] normals (\n            interpolation = \"vertex\"\n        )");
      if (!write_samples("normal3f[] normals", [&](const sim::State& state) {
            return list_of(mesh.normals(mesh.positions(state.q)), text_of);
          }))
        return false;
    }
    for (const std::string& field : sequence_.scene.fields)
      if (!write_field(mesh, field)) return false;
    line("    }}\n");
    return true;
  }

  bool write_field(const MovingMesh& mesh, const std::string& field) {
    line("        float[] primvars:{} (\n            interpolation = \"vertex\"\n        )", field);
    return write_samples("float[] primvars:" + field, [&](const sim::State& state) {
      const std::vector<sim::Field> fields = sim::fields_of(sequence_.scene.model, state.q, {field});
      return list_of(surface_values(mesh.surface(), fields.front().vertices),
                     [](double value) { return fmt::format("{}", static_cast<float>(value)); });
    });
  }

  const ExportedSequence& sequence_;
  const std::vector<MovingMesh> meshes_;
  FileStream out_;
  std::string root_;
  std::vector<std::string> names_;
};

}  // namespace

bool write_usd(const ExportedSequence& sequence, const std::filesystem::path& file) {
  make_folder(file.parent_path());
  return Writer(sequence, file).write();
}

std::vector<std::string> prim_names(const std::vector<std::string>& names) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::vector<std::string> prims;
  for (const std::string& name : names) {
    std::string prim = name.empty() || is_digit(name.front()) ? "_" : "";
    std::transform(name.begin(), name.end(), std::back_inserter(prim),
                   [&](char c) { return is_digit(c) || is_letter(c) ? c : '_'; });
    const std::string stem = prim;
    for (int n = 2; std::find(prims.begin(), prims.end(), prim) != prims.end(); ++n)
      prim = fmt::format("{}_{}", stem, n);
    prims.push_back(prim);
  }
  return prims;
}

}  // namespace lagomorph::apps
