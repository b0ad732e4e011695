#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <unistd.h>

#include "sim/error.h"
#include "sim/io/formats.h"
#include "sim/mesh_io.h"
#include "sim/tet_mesh.h"
#include "tests/support/paths.h"

/// Small meshes and files for the tests of what reads, checks and carries them.
namespace lagomorph::sim {

inline std::filesystem::path data_path(const std::string& name) {
  return lagomorph::tests::source_dir() / "tests" / "data" / name;
}

/// A folder of the test's own that goes with it.
class TempFolder {
public:
  TempFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
        std::string(test->test_suite_name()) + "_" + test->name() + "_" + std::to_string(getpid());
    std::replace(name.begin(), name.end(), '/', '_');
    path_ = std::filesystem::temp_directory_path() / ("lagomorph_" + name);
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// The message of the InputError that `action` must throw, with `folder` cut from its front.
template <typename Action>
std::string error_of(Action action, const std::filesystem::path& folder = {}) {
  try {
    action();
  } catch (const InputError& error) {
    const std::string message = error.what(), front = folder.string() + "/";
    return !folder.empty() && message.starts_with(front) ? message.substr(front.size()) : message;
  }
  return "no error";
}

/// The mesh in a file of this name and content, which is not on disk.
inline TetMesh tets_in(const std::string& name, const std::string& bytes) {
  Remarks remarks;
  return io::parse_tet_mesh({name, bytes}, remarks);
}
inline TriMesh triangles_in(const std::string& name, const std::string& bytes) {
  Remarks remarks;
  return io::parse_tri_mesh({name, bytes}, remarks);
}

/// What reading such a file fails with.
inline std::string tet_error(const std::string& name, const std::string& bytes) {
  return error_of([&] { tets_in(name, bytes); });
}
inline std::string tri_error(const std::string& name, const std::string& bytes) {
  return error_of([&] { triangles_in(name, bytes); });
}

/// `text` with its one occurrence of `from` replaced.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// One body around the unit tet of volume 1/6.
inline TetMesh one_tet() {
  TetMesh mesh;
  mesh.X.resize(4, 3);
  mesh.X << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.tets = {{0, 1, 2, 3}};
  mesh.tags = {7};
  mesh.bodies = {{"one", {0, 4}, {0, 1}}};
  return mesh;
}

/// nx×ny×nz cubes, n of them to a metre, each of six tets along its diagonal (Kuhn's).
inline TetMesh box_mesh(int nx, int ny, int nz, int n) {
  TetMesh mesh;
  const auto vertex = [=](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  mesh.X.resize((nx + 1) * (ny + 1) * (nz + 1), 3);
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) mesh.X.row(vertex(i, j, k)) = Vec3(i, j, k).transpose() / n;
    }
  }
  const int paths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        for (int p = 0; p < 6; ++p) {
          Eigen::Vector3i at(i, j, k);
          Tet tet;
          for (std::size_t corner = 0;; ++corner) {
            tet[corner] = vertex(at.x(), at.y(), at.z());
            if (corner == 3) break;
            ++at[paths[p][corner]];
          }
          if (p >= 3) std::swap(tet[2], tet[3]);  // odd paths turn the other way
          mesh.tets.push_back(tet);
          mesh.tags.push_back(p);
        }
      }
    }
  }
  mesh.bodies = {{"cube", {0, mesh.vertex_count()}, {0, mesh.tet_count()}}};
  return mesh;
}

/// n×n×n cubes of the unit cube.
inline TetMesh cube_mesh(int n) { return box_mesh(n, n, n, n); }

/// The same with its inner vertices moved, so that no two tets have the same shape.
inline TetMesh irregular_cube_mesh(int n) {
  TetMesh mesh = cube_mesh(n);
  for (Eigen::Index v = 0; v < mesh.X.rows(); ++v) {
    const Vec3 X = mesh.X.row(v);
    if (X.minCoeff() == 0.0 || X.maxCoeff() == 1.0) continue;
    for (int axis = 0; axis < 3; ++axis)
      mesh.X(v, axis) += 0.2 / n * std::sin(7.0 * static_cast<double>(v) + 2.0 * axis);
  }
  return mesh;
}

}  // namespace lagomorph::sim
