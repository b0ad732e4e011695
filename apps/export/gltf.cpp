#include "apps/export/gltf.h"

#include <bit>
#include <limits>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/export/gltf_json.h"
#include "apps/export/moving_mesh.h"
#include "apps/file_io.h"

namespace lagomorph::apps {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little endian");

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void write_words(FileStream& out, const std::vector<std::uint32_t>& words) { out.write(bytes_of(words)); }

/// The first frame's positions and normals as they are, later ones less the first's.
class Blocks {
public:
  explicit Blocks(const std::vector<MovingMesh>& meshes) : meshes_(&meshes), base_(meshes.size()) {}

  struct Block {
    std::vector<render::Vec3> positions, normals;
  };
  Block next(std::size_t body, const sim::VecX& q, bool with_normals) {
    const MovingMesh& mesh = (*meshes_)[body];
    Block block{mesh.positions(q), {}};
    if (with_normals && mesh.has_normals()) block.normals = mesh.normals(block.positions);
    Block& base = base_[body];
    if (base.positions.empty()) {
      base = block;
      return block;
    }
    for (std::size_t i = 0; i < block.positions.size(); ++i) block.positions[i] -= base.positions[i];
    for (std::size_t i = 0; i < block.normals.size(); ++i) block.normals[i] -= base.normals[i];
    return block;
  }

private:
  const std::vector<MovingMesh>* meshes_;
  std::vector<Block> base_;
};

/// Times of the key frames, from 0 on [s]; then at each the weights of all targets.
void write_animation(FileStream& out, int count, double fps) {
  std::vector<float> row;
  row.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) row.push_back(gltf_time(k, fps));
  out.write(bytes_of(row));
  row.assign(static_cast<std::size_t>(count - 1), 0.0F);
  for (int k = 0; k < count; ++k) {
    if (k > 0) row[static_cast<std::size_t>(k - 1)] = 1.0F;
    if (k > 1) row[static_cast<std::size_t>(k - 2)] = 0.0F;
    out.write(bytes_of(row));
  }
}

/// Positions, then rotations, each on the side of the one before: what is between them is the short way.
void write_camera_track(FileStream& out, std::vector<CameraPose>& poses) {
  for (const CameraPose& pose : poses) out.write(bytes_of(std::vector<render::Vec3>{pose.position}));
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Eigen::Quaternionf& r = poses[k].rotation;
    if (k > 0 && r.dot(poses[k - 1].rotation) < 0.0F) r.coeffs() = -r.coeffs();
    out.write(bytes_of(std::vector<float>{r.x(), r.y(), r.z(), r.w()}));
  }
}

}  // namespace

bool write_gltf(const ExportedSequence& sequence, const std::filesystem::path& file) {
  const std::vector<MovingMesh> meshes = moving_meshes(sequence.scene);
  const GltfLayout layout(meshes, sequence.count(), sequence.scene.moving_camera != nullptr);
  constexpr std::uint64_t limit = std::numeric_limits<std::uint32_t>::max();
  const auto check_size = [&](std::uint64_t size) {
    if (size > limit)
      wrong_input(
          fmt::format("--format gltf: {} frames take {:.1f} GiB and a .glb holds at most 4; give fewer "
                      "with --frames A..B",
                      sequence.count(), static_cast<double>(size) / (1 << 30)));
  };
  check_size(layout.size());

  sequence.begin(2);
  std::vector<std::vector<Extent>> extents(meshes.size());  // of each body, a frame
  Blocks bounds(meshes);
  std::vector<CameraPose> poses;
  const bool bounded = sequence.each([&](const sim::State& state) {
    if (sequence.scene.moving_camera) poses.push_back(pose_of(sequence.scene.moving_camera(state)));
    for (std::size_t i = 0; i < meshes.size(); ++i)
      extents[i].push_back(extent_of(bounds.next(i, state.q, false).positions));
  });
  if (!bounded) return false;

  std::string json = gltf_json(sequence, meshes, layout, extents);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t total = 12 + 8 + json.size() + 8 + layout.size();
  check_size(total);
  make_folder(file.parent_path());
  FileStream out(file);
  const auto word = [](std::uint64_t n) { return static_cast<std::uint32_t>(n); };
  write_words(out, {0x46546C67, 2, word(total), word(json.size()), 0x4E4F534A});  // "glTF", "JSON"
  out.write(json);
  write_words(out, {word(layout.size()), 0x004E4942});  // "BIN"
  for (const MovingMesh& mesh : meshes) out.write(bytes_of(mesh.triangles()));
  if (sequence.count() > 1) {
    write_animation(out, sequence.count(), sequence.scene.desc.time.fps);
    write_camera_track(out, poses);
  }
  Blocks blocks(meshes);
  const bool all = sequence.each([&](const sim::State& state) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const Blocks::Block block = blocks.next(i, state.q, true);
      out.write(bytes_of(block.positions));
      out.write(bytes_of(block.normals));
    }
  });
  for (const MovingMesh& mesh : meshes) out.write(bytes_of(mesh.colors()));
  if (all) out.finish();
  return all;
}

}  // namespace lagomorph::apps
