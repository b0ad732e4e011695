#include "apps/export/gltf_json.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/export/gltf_material.h"
#include "apps/version.h"

/// Names and numbers of the glTF 2.0 specification.
namespace lagomorph::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kUint = 5125, kFloat = 5126;              // component types
constexpr int kVertexData = 34962, kIndexData = 34963;  // targets of buffer views
constexpr std::size_t kVec3 = 3 * sizeof(float);        // [bytes]

Json json_of(const Eigen::Ref<const render::Vec3>& v) { return {v.x(), v.y(), v.z()}; }

Json camera_node(const CameraPose& pose) {
  const Eigen::Quaternionf& r = pose.rotation;
  return {{"name", "camera"},
          {"camera", 0},
          {"translation", json_of(pose.position)},
          {"rotation", {r.x(), r.y(), r.z(), r.w()}}};
}

Json camera_json(const ExportedScene& exported) {
  const SceneDesc& scene = exported.desc;
  const render::CameraSettings& camera = exported.camera;
  const double aspect = static_cast<double>(scene.render.width) / scene.render.height;
  const float scale = view_scale(camera);
  if (camera.orthographic) {
    const double half = *camera.orthographic / 2.0;
    return {{"type", "orthographic"},
            {"orthographic",
             {{"xmag", half * aspect}, {"ymag", half}, {"znear", kNear * scale}, {"zfar", kFar * scale}}}};
  }
  return {
      {"type", "perspective"},
      {"perspective",
       {{"aspectRatio", aspect}, {"yfov", camera.fov * std::numbers::pi / 180.0}, {"znear", kNear * scale}}}};
}

/// Buffer views, accessors, meshes and the animation, with the indices by which they know each other.
class Document {
public:
  Document(const ExportedSequence& sequence, const std::vector<MovingMesh>& meshes, const GltfLayout& layout)
      : sequence_(sequence), meshes_(meshes), layout_(layout) {}

  Json build(const std::vector<std::vector<Extent>>& extents) {
    add_views();
    Json nodes = Json::array(), materials = Json::array(), meshes = Json::array();
    std::uint64_t index_at = 0, frame_at = 0, color_at = 0;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      materials.push_back(gltf_material(meshes_[i], extents[i][0]));
      meshes.push_back(mesh_json(i, extents[i], {index_at, frame_at, color_at}));
      nodes.push_back({{"name", meshes_[i].name()}, {"mesh", i}});
      index_at += meshes_[i].triangles().size() * sizeof(render::Triangle);
      frame_at += meshes_[i].vertex_count() * kVec3 * (meshes_[i].has_normals() ? 2 : 1);
      color_at += meshes_[i].colors().size() * kVec3;
    }
    const SceneDesc& desc = sequence_.scene.desc;
    nodes.push_back(camera_node(pose_of(sequence_.scene.camera)));
    Json roots = Json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) roots.push_back(i);
    Json file = {{"asset", {{"version", "2.0"}, {"generator", "Lagomorph " + version()}}}};
    const std::vector<std::string> extensions = extensions_of(materials);
    if (!extensions.empty()) file["extensionsUsed"] = extensions;
    file["scene"] = 0;
    file["scenes"] = {{{"name", desc.name}, {"nodes", roots}}};
    file["nodes"] = nodes;
    file["cameras"] = {camera_json(sequence_.scene)};
    file["materials"] = materials;
    file["meshes"] = meshes;
    if (layout_.frames() > 1) file["animations"] = {animation(desc)};
    file["accessors"] = accessors_;
    file["bufferViews"] = views_;
    file["buffers"] = {{{"byteLength", layout_.size()}}};
    return file;
  }

private:
  /// Where the data of a body begin in their views. [bytes]
  struct Places {
    std::uint64_t triangles, frame, colors;
  };

  /// View 0 holds the triangles, 1 + k those of frame k, then come the animation and the colours.
  void add_views() {
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", layout_.index_bytes()}, {"target", kIndexData}});
    for (int k = 0; k < layout_.frames(); ++k)
      views_.push_back(
          {{"buffer", 0},
           {"byteOffset", layout_.frames_at() + static_cast<std::uint64_t>(k) * layout_.frame_bytes()},
           {"byteLength", layout_.frame_bytes()},
           {"byteStride", kVec3},
           {"target", kVertexData}});
    if (layout_.frames() > 1)
      views_.push_back(
          {{"buffer", 0}, {"byteOffset", layout_.index_bytes()}, {"byteLength", layout_.animation_bytes()}});
    if (layout_.color_bytes() > 0)
      views_.push_back({{"buffer", 0},
                        {"byteOffset", layout_.colors_at()},
                        {"byteLength", layout_.color_bytes()},
                        {"byteStride", kVec3},
                        {"target", kVertexData}});
  }

  std::size_t add(Json accessor) {
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
  }

  static Json accessor(int view, std::uint64_t at, int type, std::uint64_t count, const char* shape) {
    return {
        {"bufferView", view}, {"byteOffset", at}, {"componentType", type}, {"count", count}, {"type", shape}};
  }

  /// Positions and normals of a body in frame k.
  Json attributes(const MovingMesh& mesh, const Extent& extent, int k, std::uint64_t at) {
    Json positions = accessor(1 + k, at, kFloat, mesh.vertex_count(), "VEC3");
    positions["min"] = json_of(extent.min);
    positions["max"] = json_of(extent.max);
    Json attributes = {{"POSITION", add(std::move(positions))}};
    if (mesh.has_normals())
      attributes["NORMAL"] =
          add(accessor(1 + k, at + mesh.vertex_count() * kVec3, kFloat, mesh.vertex_count(), "VEC3"));
    return attributes;
  }

  Json mesh_json(std::size_t body, const std::vector<Extent>& extents, const Places& at) {
    const MovingMesh& mesh = meshes_[body];
    Json primitive = {{"attributes", attributes(mesh, extents[0], 0, at.frame)}};
    if (!mesh.colors().empty())
      primitive["attributes"]["COLOR_0"] = add(accessor(layout_.frames() > 1 ? 2 + layout_.frames() : 2,
                                                        at.colors, kFloat, mesh.vertex_count(), "VEC3"));
    primitive["indices"] = add(accessor(0, at.triangles, kUint, 3 * mesh.triangles().size(), "SCALAR"));
    primitive["material"] = body;
    Json names = Json::array();
    for (int k = 1; k < layout_.frames(); ++k) {
      primitive["targets"].push_back(attributes(mesh, extents[static_cast<std::size_t>(k)], k, at.frame));
      names.push_back(fmt::format("frame_{:04}", sequence_.frames.first + k));
    }
    Json json = {{"name", mesh.name()}, {"primitives", {primitive}}};
    if (names.empty()) return json;
    json["weights"] = std::vector<int>(names.size(), 0);
    json["extras"]["targetNames"] = names;  // as Blender and three.js know them
    return json;
  }

  /// One sampler for all bodies: their targets are the same frames.
  Json animation(const SceneDesc& desc) {
    const int view = 1 + layout_.frames();
    const auto frames = static_cast<std::uint64_t>(layout_.frames());
    Json times = accessor(view, 0, kFloat, frames, "SCALAR");
    times["min"] = {gltf_time(0, desc.time.fps)};
    times["max"] = {gltf_time(layout_.frames() - 1, desc.time.fps)};
    const std::size_t input = add(std::move(times));
    const std::size_t output =
        add(accessor(view, layout_.time_bytes(), kFloat, frames * (frames - 1), "SCALAR"));
    Json channels = Json::array();
    for (std::size_t i = 0; i < meshes_.size(); ++i)
      channels.push_back({{"sampler", 0}, {"target", {{"node", i}, {"path", "weights"}}}});
    Json samplers = Json::array();
    const auto add_sampler = [&](std::size_t values) {
      samplers.push_back({{"input", input}, {"interpolation", "LINEAR"}, {"output", values}});
    };
    add_sampler(output);
    if (sequence_.scene.moving_camera) {
      const std::uint64_t at = layout_.time_bytes() + layout_.weight_bytes();
      add_sampler(add(accessor(view, at, kFloat, frames, "VEC3")));
      add_sampler(add(accessor(view, at + frames * kVec3, kFloat, frames, "VEC4")));
      const std::size_t node = meshes_.size();
      channels.push_back({{"sampler", 1}, {"target", {{"node", node}, {"path", "translation"}}}});
      channels.push_back({{"sampler", 2}, {"target", {{"node", node}, {"path", "rotation"}}}});
    }
    return {{"name", desc.name}, {"channels", channels}, {"samplers", samplers}};
  }

  const ExportedSequence& sequence_;
  const std::vector<MovingMesh>& meshes_;
  const GltfLayout& layout_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

}  // namespace

GltfLayout::GltfLayout(const std::vector<MovingMesh>& meshes, int frames, bool camera_moves)
    : frames_(frames) {
  for (const MovingMesh& mesh : meshes) {
    index_bytes_ += mesh.triangles().size() * sizeof(render::Triangle);
    frame_bytes_ += mesh.vertex_count() * kVec3 * (mesh.has_normals() ? 2 : 1);
    color_bytes_ += mesh.colors().size() * kVec3;
  }
  if (frames == 1) return;
  const auto n = static_cast<std::uint64_t>(frames);
  time_bytes_ = n * sizeof(float);
  weight_bytes_ = n * (n - 1) * sizeof(float);
  if (camera_moves) camera_bytes_ = n * (3 + 4) * sizeof(float);
}

std::string gltf_json(const ExportedSequence& sequence, const std::vector<MovingMesh>& meshes,
                      const GltfLayout& layout, const std::vector<std::vector<Extent>>& extents) {
  return Document(sequence, meshes, layout).build(extents).dump();
}

}  // namespace lagomorph::apps
