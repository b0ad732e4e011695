#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "tests/unit/apps/pipeline/run_fixture.h"

/// Wavefront files as other tools see them.
namespace lagomorph::tests {
namespace obj_test {

using Vector = Eigen::Vector3d;

/// What an .obj holds of each object, in its own vertices.
struct ObjObject {
  std::string material, smoothing;
  std::vector<Vector> vertices, normals;
  struct Corner {
    std::size_t vertex, normal;  // 0-based; npos of none
  };
  std::vector<std::array<Corner, 3>> faces;
};
constexpr std::size_t npos = std::string::npos;

struct ObjFile {
  std::string library;
  std::map<std::string, ObjObject> objects;
};

/// Written anew from the manual, without the program's own reader.
ObjFile parsed(const std::filesystem::path& path) {
  ObjFile file;
  ObjObject* object = nullptr;
  std::size_t vertices = 0, normals = 0, first = 0, first_normal = 0;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    const auto vector = [&] {
      Vector v;
      words >> v.x() >> v.y() >> v.z();
      EXPECT_TRUE(words) << line;
      return v;
    };
    if (key == "mtllib") {
      words >> file.library;
    } else if (key == "o") {
      std::string name;
      words >> name;
      EXPECT_EQ(file.objects.count(name), 0U) << name;
      object = &file.objects[name];
      first = vertices, first_normal = normals;
    } else if (key == "v") {
      object->vertices.push_back(vector());
      ++vertices;
    } else if (key == "vn") {
      object->normals.push_back(vector());
      ++normals;
    } else if (key == "usemtl") {
      words >> object->material;
    } else if (key == "s") {
      words >> object->smoothing;
    } else if (key == "f") {
      std::array<ObjObject::Corner, 3> face{};
      for (ObjObject::Corner& corner : face) {
        std::string word;
        words >> word;
        const std::size_t slashes = word.find("//");
        corner.vertex = std::stoul(word.substr(0, slashes)) - 1 - first;
        corner.normal = slashes == npos ? npos : std::stoul(word.substr(slashes + 2)) - 1 - first_normal;
      }
      object->faces.push_back(face);
    } else {
      EXPECT_TRUE(key.empty() || key == "#") << line;
    }
  }
  return file;
}

class ExportObj : public ProgramRun {
protected:
  /// A smooth metal and a flat see-through body, whose names need care.
  void simulate_two() const {
    const std::string mesh = data_file("run/bar.msh").string();
    std::ofstream(at("two bars.toml"))
        << "time = { frames = 3 }\n[[body]]\nname = 'left bar'\nmesh = '" << mesh
        << "'\nspin = [0, 9, 0]\nlook = { base_color = [0.25, 0.5, 0.75], metallic = 1, roughness = 0.5 }\n"
        << "[[body]]\nname = 'left_bar'\nmesh = '" << mesh
        << "'\ntranslate = [2, 0, 0]\nsurface = { smooth = false }\n"
        << "look = { opacity = 0.5, ior = 1.25, coat = 0.75, coat_roughness = 0.125, sheen = 0.25 }\n";
    expect(0, {"simulate", at("two bars.toml").string(), "-o", at("run").string(), "--quiet"});
  }
  std::string export_obj(const Arguments& more = {}) const {
    return expect(0, Arguments{"export", at("run").string(), "--format", "obj"} + more);
  }
};

TEST_F(ExportObj, HasAnObjectAndAMaterialForEachBody) {
  simulate_two();
  export_obj();
  const ObjFile obj = parsed(at("run/export/frame_0002.obj"));
  EXPECT_EQ(obj.library, "two_bars.mtl");
  ASSERT_EQ(obj.objects.size(), 2U);
  const ObjObject& smooth = obj.objects.at("left_bar");
  const ObjObject& flat = obj.objects.at("left_bar_2");
  EXPECT_EQ(smooth.material, "left_bar");
  EXPECT_EQ(flat.material, "left_bar_2");
  EXPECT_EQ(smooth.faces.size(), flat.faces.size());
  ASSERT_EQ(smooth.vertices.size(), flat.vertices.size());
  double apart = 0.0;
  for (const Vector& v : flat.vertices) apart += v.x() / static_cast<double>(flat.vertices.size());
  for (const Vector& v : smooth.vertices) apart -= v.x() / static_cast<double>(smooth.vertices.size());
  EXPECT_NEAR(apart, 2.0, 0.01) << "vertices of another body";
  EXPECT_EQ(smooth.smoothing, "1");
  EXPECT_EQ(flat.smoothing, "off");
  EXPECT_TRUE(flat.normals.empty());
  for (const auto& face : flat.faces)
    for (const ObjObject::Corner& c : face) EXPECT_EQ(c.normal, npos);
}

/// The angle-weighted mean of the triangles' normals, as pictures are shaded by.
TEST_F(ExportObj, HasTheNormalsOfSmoothBodies) {
  simulate_two();
  export_obj();
  for (const char* frame : {"run/export/frame_0000.obj", "run/export/frame_0002.obj"}) {
    const ObjFile file = parsed(at(frame));
    const ObjObject& body = file.objects.at("left_bar");
    ASSERT_EQ(body.normals.size(), body.vertices.size());
    std::vector<Vector> sums(body.vertices.size(), Vector::Zero());
    for (const auto& face : body.faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(face[k].normal, face[k].vertex);
        const Vector& x = body.vertices.at(face[k].vertex);
        const Vector a = body.vertices.at(face[(k + 1) % 3].vertex) - x,
                     b = body.vertices.at(face[(k + 2) % 3].vertex) - x, normal = a.cross(b);
        sums[face[k].vertex] += std::atan2(normal.norm(), a.dot(b)) * normal.normalized();
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
      ASSERT_LT((body.normals[i] - sums[i].normalized()).norm(), 1e-4) << frame << " " << i;
  }
}

TEST_F(ExportObj, TheLibraryHasTheLooks) {
  simulate_two();
  const std::string said = export_obj();
  EXPECT_EQ(said.find("left out"), std::string::npos) << said;
  const std::string library = read_all(at("run/export/two_bars.mtl"));
  EXPECT_NE(
      library.find("\nnewmtl left_bar\nNs 250\nKa 1 1 1\nKd 0.25 0.5 0.75\nKs 0.5 0.5 0.5\nNi 1.5\nd 1\n"
                   "illum 3\nPr 0.5\nPm 1\n\n"),
      std::string::npos)
      << library;
  EXPECT_NE(
      library.find("\nnewmtl left_bar_2\nNs 250\nKa 1 1 1\nKd 0.8 0.8 0.8\nKs 0.154321 0.154321 0.154321\n"
                   "Ni 1.25\nd 0.5\nillum 9\nPr 0.5\nPm 0\nPs 0.25\nPc 0.75\nPcr 0.125\n"),
      std::string::npos)
      << library;
}

TEST_F(ExportObj, TellsWhatItLeavesOut) {
  expect(0, simulate("run",
                     {"--frames", "0", "--set",
                      "body.0.look={ transmission = 1, absorption_color = [1, 0.5, 0.25], field = 'J' }"}));
  EXPECT_NE(
      export_obj().find("obj: transmission (an opaque base of absorption_color), the colours of J of body "
                        "'bar' are left out\n"),
      std::string::npos);
  EXPECT_NE(read_all(at("run/export/bar.mtl")).find("\nKd 1 0.5 0.25\n"), std::string::npos);
}

TEST_F(ExportObj, HasTheSameBytesForAnyThreads) {
  simulate_two();
  for (const char* threads : {"1", "3"}) export_obj({"--threads", threads, "-o", at(threads).string()});
  EXPECT_EQ(tree(at("1")), tree(at("3")));
  EXPECT_EQ(count_files(at("1")), 4);
}

TEST_F(ExportObj, AFrameThatCannotBeWrittenLeavesNone) {
  simulate_two();
  const std::string error =
      expect(4, {"export", at("run").string(), "--quiet", "--format", "obj"}, {.largest_file = 1000});
  EXPECT_NE(error.find("frame_0000.obj"), std::string::npos) << error;
  EXPECT_EQ(count_files(at("run/export")), 1) << "the materials alone";
}

}  // namespace obj_test
}  // namespace lagomorph::tests
