#include "render/raster/mesh_buffers.h"

#include <algorithm>
#include <cstdint>

#include "render/raster/by_rays.h"

namespace lagomorph::render::raster {
namespace {

void attribute(GLuint index, const Buffer& buffer, std::size_t vertex_count) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertex_count * sizeof(Vec3)), nullptr,
               GL_DYNAMIC_DRAW);
  glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, sizeof(Vec3), nullptr);
  glEnableVertexAttribArray(index);
}

template <class Value>
void fill(const Buffer& buffer, std::span<const Value> values) {
  static_assert(sizeof(Value) == sizeof(Vec3));
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(values.size_bytes()), values.data());
}

}  // namespace

bool is_closed(std::span<const Triangle> triangles, std::span<const Vec3> positions) {
  const auto key = [](std::uint32_t a, std::uint32_t b) {
    return (static_cast<std::uint64_t>(a) << 32U) | b;
  };
  std::vector<std::uint64_t> edges, opposite;
  edges.reserve(3 * triangles.size());
  opposite.reserve(3 * triangles.size());
  double volume = 0.0;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.push_back(key(t[i], t[(i + 1) % 3]));
      opposite.push_back(key(t[(i + 1) % 3], t[i]));
    }
    const Vec3 a = positions[t[0]] - positions[triangles[0][0]];
    const Vec3 b = positions[t[1]] - positions[triangles[0][0]];
    const Vec3 c = positions[t[2]] - positions[triangles[0][0]];
    volume += static_cast<double>(a.dot(b.cross(c)));
  }
  std::sort(edges.begin(), edges.end());
  std::sort(opposite.begin(), opposite.end());
  return volume > 0.0 && edges == opposite && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

MeshBuffers::MeshBuffers(const Mesh& mesh, bool clear)
    : triangles_(mesh.triangles),
      topology_(mesh.triangles, mesh.positions.size()),
      material_(mesh.material),
      body_id_(mesh.body_id),
      smooth_(mesh.smooth),
      closed_(is_closed(mesh.triangles, mesh.positions)),
      colored_(!mesh.colors.empty()),
      clear_(clear),
      opacity_to_light_(raster::opacity_to_light(mesh, clear)) {
  glBindVertexArray(vertex_array_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles_.size() * sizeof(Triangle)),
               triangles_.data(), GL_STATIC_DRAW);
  attribute(0, position_buffer_, mesh.positions.size());
  if (smooth_) attribute(1, normal_buffer_, mesh.positions.size());
  if (colored_) attribute(2, color_buffer_, mesh.positions.size());
  upload(std::span<const Vec3>(mesh.positions));
  if (colored_) upload(std::span<const Color>(mesh.colors));
}

void MeshBuffers::upload(std::span<const Vec3> positions) {
  fill(position_buffer_, positions);
  moves_ = false;
  if (!smooth_) return;
  topology_.compute(triangles_, positions, normals_);
  fill(normal_buffer_, std::span<const Vec3>(normals_));
}

void MeshBuffers::upload_previous(std::span<const Vec3> positions) {
  if (!previous_buffer_) {
    glBindVertexArray(vertex_array_.id());
    attribute(3, previous_buffer_.emplace(), positions.size());
  }
  fill(*previous_buffer_, positions);
  moves_ = true;
}

void MeshBuffers::upload(std::span<const Color> colors) { fill(color_buffer_, colors); }

void MeshBuffers::draw() const {
  glBindVertexArray(vertex_array_.id());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles_.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace lagomorph::render::raster
