#include "apps/export/usd.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "apps/export/moving_mesh.h"
#include "apps/file_io.h"
#include "apps/pipeline/surface_fields.h"
#include "apps/version.h"
#include "render/albedo.h"

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
    int passes = sequence_.scene.moving_camera ? 1 : 0;
    for (const MovingMesh& mesh : meshes_)
      passes += (mesh.has_normals() ? 2 : 1) + static_cast<int>(sequence_.scene.fields.size());
    sequence_.begin(passes);
    if (!find_cameras()) return false;
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

  /// The cameras of the frames, or the one of all. False: asked to stop.
  bool find_cameras() {
    if (!sequence_.scene.moving_camera) {
      cameras_[sequence_.frames.first] = sequence_.scene.camera;
      return true;
    }
    return sequence_.each(
        [&](const sim::State& state) { cameras_[state.frame] = sequence_.scene.moving_camera(state); });
  }

  /// An attribute of the camera: once where it is the same in all frames, else by time.
  template <class Text>
  void write_of_camera(const std::string& attribute, Text text) {
    std::set<std::string> all;
    for (const auto& [frame, settings] : cameras_) all.insert(text(settings));
    if (all.size() == 1) {
      line("        {} = {}", attribute, *all.begin());
      return;
    }
    line("        {}.timeSamples = {{", attribute);
    for (const auto& [frame, settings] : cameras_) line("            {}: {},", frame, text(settings));
    line("        }}");
  }

  /// Apertures and focal length are in tenths of a unit; that of a perspective is as of a film 24 mm high.
  void write_camera(const SceneDesc& desc) {
    const bool is_flat = sequence_.scene.camera.orthographic.has_value();
    const double aspect = static_cast<double>(desc.render.width) / desc.render.height;
    const auto height = [](const render::CameraSettings& c) {
      return c.orthographic ? 10.0 * static_cast<double>(*c.orthographic) : 24.0;
    };
    const auto number = [](double value) { return fmt::format("{}", static_cast<float>(value)); };
    const auto transform = [](const render::CameraSettings& c) {
      const render::Camera camera(c, 1, 1);
      const render::Vec3 back = -camera.forward();
      const auto row = [](const render::Vec3& v, int last) {
        return fmt::format("({}, {}, {}, {})", v.x(), v.y(), v.z(), last);
      };
      return fmt::format("( {}, {}, {}, {} )", row(camera.right(), 0), row(camera.up(), 0), row(back, 0),
                         row(camera.position(), 1));
    };
    line("    def Camera \"camera\"\n    {{");
    write_of_camera("float2 clippingRange", [](const render::CameraSettings& c) {
      return fmt::format("({}, {})", kNear * view_scale(c), kFar * view_scale(c));
    });
    if (!is_flat) {
      write_of_camera("float focalLength", [&](const render::CameraSettings& c) {
        return number(24.0 / 2 / std::tan(static_cast<double>(c.fov) * std::numbers::pi / 360));
      });
    }
    write_of_camera("float horizontalAperture",
                    [&](const render::CameraSettings& c) { return number(height(c) * aspect); });
    write_of_camera("float verticalAperture",
                    [&](const render::CameraSettings& c) { return number(height(c)); });
    line("        token projection = \"{}\"", is_flat ? "orthographic" : "perspective");
    write_of_camera("matrix4d xformOp:transform", transform);
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
    line("                color3f inputs:diffuseColor = {}", text_of(render::albedo(look).matrix()));
    line("                float inputs:metallic = {}", look.metallic);
    line("                float inputs:roughness = {}", look.roughness);
    line("                float inputs:ior = {}", look.ior);
    if (look.coat > 0.0F) {
      line("                float inputs:clearcoat = {}", look.coat);
      line("                float inputs:clearcoatRoughness = {}", look.coat_roughness);
    }
    if (look.opacity < 1.0F) {  // of what is there, highlights and all
      line("                float inputs:opacity = {}", look.opacity);
      line("                token inputs:opacityMode = \"presence\"");
    }
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
    line(
        "        color3f[] primvars:displayColor = [{}] (\n            interpolation = \"constant\"\n        "
        ")",
        text_of(render::albedo(mesh.look()).matrix()));
    if (mesh.look().opacity < 1.0F)
      line(
          "        float[] primvars:displayOpacity = [{}] (\n            interpolation = \"constant\"\n      "
          "  )",
          mesh.look().opacity);
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
  std::map<int, render::CameraSettings> cameras_;  // by frame
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
