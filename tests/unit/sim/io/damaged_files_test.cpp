// Whatever is done to a file, reading it succeeds or throws an InputError: never another exception, a crash
// or a huge allocation.
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace damaged_files_test {

struct Damaged {
  std::string name;   // of the file that is damaged
  std::string bytes;  // as it was
};

std::string read_data(const std::string& name) {
  std::ifstream file(data_path("meshes/" + name), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Damaged> small_files() {
  std::vector<Damaged> files;
  TriMesh surface;
  surface.X = one_tet().X;
  surface.triangles = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (const std::string& e : tet_mesh_extensions())
    files.push_back({"written" + e, write_tet_mesh(one_tet(), e)});
  for (const std::string& e : tri_mesh_extensions())
    files.push_back({"written" + e, write_tri_mesh(surface, e)});
  for (const char* name :
       {"two_boxes_22_binary.msh", "two_boxes_41_binary.msh", "two_boxes_41_partitioned.msh",
        "two_boxes_42_binary.vtk", "two_boxes_51_binary.vtk", "two_boxes_51.vtk", "two_boxes_binary_zlib.vtu",
        "two_boxes_raw_zlib.vtu", "two_boxes_raw_big_endian.vtu", "cube_big_endian.ply", "cube_ascii.ply",
        "cube_binary.stl", "cube.obj"}) {
    files.push_back({name, read_data(name)});
  }
  return files;
}

/// Whether it could be read; any exception but an InputError leaves it.
bool can_read(const std::string& path, const std::string& bytes) {
  const auto extensions = tet_mesh_extensions();
  const std::string extension = std::filesystem::path(path).extension().string();
  try {
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) {
      tets_in(path, bytes);
    } else {
      triangles_in(path, bytes);
    }
    return true;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with(path)) << message;
    return false;
  }
}

class DamagedFiles : public testing::TestWithParam<Damaged> {
protected:
  /// The other file of a TetGen pair is whole, on disk.
  DamagedFiles() {
    folder_.write("written.node", write_tet_mesh(one_tet(), ".node"));
    folder_.write("written.ele", write_tet_mesh(one_tet(), ".ele"));
    path_ = (folder_.path() / GetParam().name).string();
  }
  std::string path_;

private:
  TempFolder folder_;
};

TEST_P(DamagedFiles, CutShortAreReadOrRefused) {
  const std::string& bytes = GetParam().bytes;
  EXPECT_TRUE(can_read(path_, bytes));
  std::size_t read = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_NO_THROW(read += can_read(path_, bytes.substr(0, size))) << size;
  }
  EXPECT_LT(read, bytes.size() / 2);
}

TEST_P(DamagedFiles, WithFlippedBytesAreReadOrRefused) {
  std::mt19937 random(1234);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = GetParam().bytes;
    for (int flips = 1 + i % 3; flips > 0; --flips)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    ASSERT_NO_THROW(can_read(path_, bytes)) << i;
  }
}

TEST_P(DamagedFiles, WithOtherNumbersAreReadOrRefused) {
  std::mt19937 random(99);
  for (int i = 0; i < 500; ++i) {
    std::string bytes = GetParam().bytes;
    std::size_t at = random() % bytes.size();
    for (std::size_t k = 0; k < bytes.size() && (bytes[at] < '0' || bytes[at] > '9'); ++k)
      at = (at + 1) % bytes.size();
    const char* numbers[] = {
        "-1",   "99999", "4000000000", "-9223372036854775808", "9223372036854775807", "18446744073709551615",
        "1e308"};
    bytes.replace(at, 1, numbers[random() % std::size(numbers)]);
    ASSERT_NO_THROW(can_read(path_, bytes)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFiles, testing::ValuesIn(small_files()), [](const auto& info) {
  std::string name = info.param.name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

}  // namespace damaged_files_test
}  // namespace lagomorph::sim
