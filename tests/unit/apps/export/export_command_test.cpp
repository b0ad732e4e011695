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

TEST_F(ExportCommand, WritesTheDrawnSurface) {
  expect(0, simulate("run"));
  EXPECT_EQ(exported({"--format", "ply", "--frames", "2", "--fields", "von_mises", "-o",
                      at("ply").string()})["files"],
            Json::parse(R"(["frame_0002.ply"])"));
  exported({"--format", "obj", "--frames", "2..3", "-o", at("obj").string()});
  EXPECT_EQ(count_files(at("obj")), 2);
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
