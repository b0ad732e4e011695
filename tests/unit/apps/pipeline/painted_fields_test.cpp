#include "apps/pipeline/painted_fields.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/info/info.h"
#include "apps/npy.h"
#include "apps/pipeline/build_scene.h"
#include "apps/run/inputs.h"
#include "apps/scene/scene.h"
#include "sim/error.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace painted_fields_test {

/// Two tets, of tags 1 and 2, beside each other along x.
class TwoTets : public testing::Test {
protected:
  TwoTets() {
    directory.write("two.mesh",
                    "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                    "1 1 1 0\nTetrahedra\n2\n1 2 3 4 1\n2 3 4 5 2\nEnd\n");
    paint({2e5, 3e5});
  }
  void paint(const std::vector<double>& values) {
    directory.write("young.npy", npy_bytes(values, std::vector<std::size_t>{values.size()}));
  }
  SceneDesc scene(const std::string& more) {
    return load_scene(directory.write("two.toml",
                                      "[[body]]\nmesh = 'two.mesh'\n"
                                      "material = { model = 'neo_hookean', young = 4e5, poisson = 0.25 }\n" +
                                          more),
                      {});
  }
  std::string error(const std::string& more) {
    try {
      Progress quiet(true);
      build_model(scene(more), quiet);
    } catch (const std::exception& e) {
      const std::string message = e.what(), front = directory.path().string() + "/";
      return message.starts_with(front) ? message.substr(front.size()) : message;
    }
    return "no error";
  }
  tests::TemporaryDirectory directory;
};

TEST_F(TwoTets, RegionsTakeFromTheBodyWhatTheyLeaveOpen) {
  const SceneDesc two = scene(
      "[[body.region]]\ntag = 2\nmaterial = { young = 9e5 }\n"
      "[[body.region]]\ntag = [1, 2]\ndensity = 5\nmaterial = { mu = 3e5, lambda = 1e5 }\n"
      "[[body.region]]\ntag = 1\nmaterial = { model = 'stable_neo_hookean' }\n");
  const auto& regions = two.body[0].physics.region;
  ASSERT_EQ(regions.size(), 3U);
  EXPECT_EQ(regions[0].material->model, "neo_hookean");
  EXPECT_EQ(regions[0].material->young, 9e5);
  EXPECT_EQ(regions[0].material->poisson, 0.25);
  EXPECT_EQ(regions[0].density, std::nullopt);
  EXPECT_EQ(regions[1].material->model, "neo_hookean");
  EXPECT_EQ(regions[1].material->young, std::nullopt);
  EXPECT_EQ(regions[2].material->model, "stable_neo_hookean");
  EXPECT_EQ(regions[2].material->young, 4e5);
  const std::string toml = scene_to_toml(two);
  EXPECT_EQ(scene_to_toml(parse_scene(toml, directory.path() / "two.toml", {})), toml);
}

TEST_F(TwoTets, InfoTellsTheRangesOfConstants) {
  scene(
      "[[body.region]]\ntag = 2\ndensity = 10\nmaterial = { model = 'arap' }\n"
      "[[body.field]]\nkey = 'young'\nfile = 'young.npy'\n");
  const auto json = nlohmann::json::parse(scene_info(directory.path() / "two.toml", {}).json());
  const auto& body = json["bodies"][0];
  EXPECT_EQ(body["ranges"]["young"], nlohmann::json({2e5, 3e5}));
  EXPECT_EQ(body["ranges"]["density"], nlohmann::json({10.0, 1000.0}));
  EXPECT_EQ(body["models"]["arap"], 1);
  EXPECT_EQ(body["models"]["neo_hookean"], 1);
}

TEST_F(TwoTets, WhatIsPaintedCountsByItsContentsAndGoesIntoTheRun) {
  const std::string more = "[[body.field]]\nkey = 'young'\nfile = 'young.npy'\n";
  const auto value = [&] {
    for (const ResolvedKey& k : simulation_keys(scene(more)))
      if (k.key == "body.0.field.0.file") return k.value;
    return std::string();
  };
  const std::string first = value();
  EXPECT_TRUE(first.starts_with("sha256:")) << first;
  paint({2e5, 4e5});
  EXPECT_NE(value(), first);
  const RunPaths run(directory.path() / "run");
  write_inputs(scene(more), run);
  EXPECT_EQ(read_file(run.inputs() / "young.npy"), read_file(directory.path() / "young.npy"));
  EXPECT_EQ(self_contained(scene(more), run).body[0].physics.field[0].file, "inputs/young.npy");
}

TEST_F(TwoTets, TellWhatIsWrongWithItsPlace) {
  const std::string field = "[[body.field]]\nkey = 'young'\nfile = 'young.npy'\n";
  EXPECT_EQ(error(field), "no error");
  paint({2e5, -1.0});
  EXPECT_EQ(error(field), "two.toml:4:1: body.0.field.0: young.npy: tet 1: young = -1 must be > 0 Pa");
  paint({1, 2, 3});
  EXPECT_EQ(
      error(field),
      "two.toml:4:1: body.0.field.0: young.npy: has 3 values; 2, one a tet, or 5, one a vertex, would be "
      "right");
  directory.write("young.npy", npy_bytes(std::vector<double>{1, 2}, std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(
      error(field),
      "two.toml:4:1: body.0.field.0: young.npy: has shape (2, 1); one value a tet, or one a vertex, would "
      "be right");
  EXPECT_EQ(error("[[body.field]]\nkey = 'young'\nfile = 'none.npy'\n"),
            "two.toml:6:8: body.0.field.0.file = 'none.npy': there is no such file");
  EXPECT_EQ(
      error("[[body.region]]\ntag = 3\ndensity = 1\n"),
      "two.toml:4:1: body.0.region.0: tag 3 selects none of the centroids of 2 tets; the mesh has 1, 2");
  EXPECT_EQ(error("[[body.region]]\ntag = 2\nmaterial = { young = 1e5, mu = 3 }\n"),
            "two.toml:6:12: body.0.region.0.material: mu is given without lambda; give both");
}

}  // namespace painted_fields_test
}  // namespace lagomorph::apps
