#include <algorithm>

#include "apps/run/state_file.h"
#include "sim/io/vtu_arrays.h"
#include "sim/mesh_io.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// `lagomorph export` as scripts see it.
namespace lagomorph::tests {
namespace export_command_test {

using Json = nlohmann::json;

class ExportCommand : public ProgramRun {
protected:
  Json exported(const Arguments& more) const {
    const Ended ended = run_program(Arguments{"export", at("run").string(), "--json"} + more);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return Json::parse(ended.out);
  }
};

TEST_F(ExportCommand, WritesTetsWithFieldsAndTheirTimes) {
  expect(0, simulate("run"));
  const Json json = exported({});
  EXPECT_EQ(json["files"],
            Json::parse(R"(["frame_0000.vtu", "frame_0001.vtu", "frame_0002.vtu", "frame_0003.vtu",
                                           "bar.pvd"])"));
  EXPECT_EQ(count_files(at("run/export")), 5);
  sim::Remarks remarks;
  const sim::TetMesh rest = sim::read_tet_mesh(at("run/mesh.msh"), remarks);
  const sim::TetMesh first = sim::read_tet_mesh(at("run/export/frame_0000.vtu"), remarks);
  const sim::TetMesh last = sim::read_tet_mesh(at("run/export/frame_0003.vtu"), remarks);
  EXPECT_EQ(first.X, rest.X);
  EXPECT_EQ(last.tets, rest.tets);
  EXPECT_NE(last.X, rest.X);
  const std::string vtu = read_all(at("run/export/frame_0003.vtu"));
  for (const char* name : {"von_mises", "J", "energy_density", "displacement"})
    EXPECT_NE(vtu.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  EXPECT_NE(read_all(at("run/export/bar.pvd"))
                .find("<DataSet timestep=\"0.10000000000000001\" part=\"0\" file=\"frame_0003.vtu\"/>"),
            std::string::npos);
}

/// The point data of a .vtu, by name.
class PointsOf {
public:
  explicit PointsOf(const std::filesystem::path& path) : file_(sim::io::read_file(path)), arrays_(file_) {}

  std::vector<double> operator()(const std::string& name, int components) {
    const pugi::xml_node array = data().find_child_by_attribute("DataArray", "Name", name.c_str());
    EXPECT_TRUE(array) << name;
    if (!array) return {};
    EXPECT_EQ(array.attribute("NumberOfComponents").as_int(1), components) << name;
    const auto n = piece().attribute("NumberOfPoints").as_uint();
    return arrays_.numbers(array, n * static_cast<std::uint64_t>(components));
  }
  pugi::xml_node piece() const { return arrays_.root().child("UnstructuredGrid").child("Piece"); }
  pugi::xml_node data() const { return piece().child("PointData"); }

private:
  sim::io::File file_;
  sim::io::VtuArrays arrays_;
};

std::vector<double> list(const auto& values) { return {values.begin(), values.end()}; }

TEST_F(ExportCommand, GivesTheVectorsOfTheState) {
  expect(0, simulate("run"));
  exported({"--frames", "3"});
  sim::Remarks remarks;
  const sim::Points rest = sim::read_tet_mesh(at("run/mesh.msh"), remarks).X;
  const sim::State state =
      apps::read_state(at("run/states/frame_0003.npy"), 3, 30, static_cast<int>(rest.rows()));
  PointsOf points(at("run/export/frame_0003.vtu"));
  const sim::VecX moved = state.q - Eigen::Map<const sim::VecX>(rest.data(), rest.size());
  ASSERT_GT(moved.norm(), 0.0);
  ASSERT_GT(state.qdot.norm(), 0.0);
  EXPECT_EQ(points("displacement", 3), list(moved));
  EXPECT_EQ(points("velocity", 3), list(state.qdot));
  EXPECT_EQ(points.data().attribute("Vectors").value(), std::string("displacement"));
  const double low = rest.col(1).minCoeff(), high = rest.col(1).maxCoeff();
  std::vector<double> held;  // the upmost tenth
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
    held.push_back(rest(v, 1) > high - 0.1 * (high - low) - 1e-9 ? 1 : 0);
  EXPECT_EQ(points("pinned", 1), held);
  EXPECT_GT(std::count(held.begin(), held.end(), 0.0), 0);
  EXPECT_TRUE(points.piece().child("CellData").find_child_by_attribute("Name", "von_mises"));
  EXPECT_FALSE(points.piece().child("CellData").find_child_by_attribute("Name", "displacement"))
      << "a scalar of the same name";
}

TEST_F(ExportCommand, GivesTheVectorsWhateverTheFields) {
  expect(0, simulate("run"));
  exported({"--frames", "1", "--fields", "J"});
  const PointsOf points(at("run/export/frame_0001.vtu"));
  std::vector<std::string> names;
  for (const pugi::xml_node array : points.data()) names.emplace_back(array.attribute("Name").value());
  EXPECT_EQ(names, (std::vector<std::string>{"J", "displacement", "velocity", "pinned"}));
  exported({"--frames", "1", "--fields", "displacement"});
  EXPECT_FALSE(PointsOf(at("run/export/frame_0001.vtu")).data().attribute("Scalars"));
}

TEST_F(ExportCommand, APinThatLetGoHoldsNoMore) {
  expect(0, simulate("run", {"--set", "body.0.pin.0.release=0.05"}));  // between frames 1 and 2
  exported({"--frames", "1..2"});
  const std::vector<double> before = PointsOf(at("run/export/frame_0001.vtu"))("pinned", 1),
                            after = PointsOf(at("run/export/frame_0002.vtu"))("pinned", 1);
  EXPECT_GT(std::count(before.begin(), before.end(), 1.0), 0);
  EXPECT_EQ(after, std::vector<double>(before.size(), 0.0));
}

TEST_F(ExportCommand, WritesTheDrawnSurface) {
  expect(0, simulate("run"));
  EXPECT_EQ(exported({"--format", "ply", "--frames", "2", "--fields", "von_mises", "-o",
                      at("ply").string()})["files"],
            Json::parse(R"(["frame_0002.ply"])"));
  EXPECT_EQ(exported({"--format", "obj", "--frames", "2..3", "-o", at("obj").string()})["files"],
            Json::parse(R"(["bar.mtl", "frame_0002.obj", "frame_0003.obj"])"));
  EXPECT_EQ(count_files(at("obj")), 3);
  sim::Remarks remarks;
  const sim::TriMesh ply = sim::read_tri_mesh(at("ply/frame_0002.ply"), remarks);
  const sim::TriMesh obj = sim::read_tri_mesh(at("obj/frame_0002.obj"), remarks);
  EXPECT_EQ(ply.X, obj.X);
  EXPECT_EQ(ply.triangles, obj.triangles);
  EXPECT_NE(read_all(at("ply/frame_0002.ply")).find("property double von_mises\n"), std::string::npos);
}

TEST_F(ExportCommand, SaysWhatIsWrong) {
  expect(0, simulate("run"));
  const auto refusal = [&](const Arguments& arguments) { return expect(2, Arguments{"export"} + arguments); };
  const std::string run = at("run").string();
  EXPECT_NE(refusal({run, "--format", "stl"}).find("known are vtu, ply, obj"), std::string::npos);
  EXPECT_NE(refusal({run, "--fields", "mises"}).find("unknown field 'mises'"), std::string::npos);
  EXPECT_NE(refusal({run, "--format", "obj", "--fields", "J"}).find("holds no fields"), std::string::npos);
  EXPECT_NE(refusal({run, "--frames", "9"}).find("9"), std::string::npos);
  EXPECT_NE(refusal({at("nowhere").string()}).find("there is no such run"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(at("run/export")));
}

/// One of coarse tets is exported as smooth as it is drawn.
TEST_F(ExportCommand, WritesTheSubdividedSurface) {
  expect(0, simulate("run", {"--set", "body.0.surface={ mesh = '', subdivide = 1 }"}));
  const nlohmann::json sizes = run_json("run").at("mesh").at("bodies").at(0);
  exported({"--format", "ply", "--frames", "2", "--fields", "von_mises"});
  sim::Remarks remarks;
  const sim::TriMesh ply = sim::read_tri_mesh(at("run/export/frame_0002.ply"), remarks);
  EXPECT_EQ(ply.triangles.size(), sizes.at("surface_triangles").get<std::size_t>());
  EXPECT_EQ(ply.X.rows(), 2 + static_cast<Eigen::Index>(ply.triangles.size()) / 2) << "closed";
  EXPECT_EQ(ply.triangles.size() % 4, 0U);
}

}  // namespace export_command_test
}  // namespace lagomorph::tests
