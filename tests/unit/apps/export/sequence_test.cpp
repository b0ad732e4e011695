#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string_view>

#include "apps/export/usd.h"
#include "render/colormap.h"
#include "sim/mesh_io.h"
#include "tests/unit/apps/export/glb.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// Whole sequences in a file: binary glTF and USD ASCII, held to the frames as .ply.
namespace lagomorph::tests {
namespace sequence_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr float kRounding = 3e-7F;  // of coordinates below 1 m, added in single precision

class ExportSequence : public ProgramRun {
protected:
  Json exported(const std::string& format, const Arguments& more = {}) const {
    const Ended ended =
        run_program(Arguments{"export", at("run").string(), "--format", format, "--json"} + more);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return Json::parse(ended.out);
  }
  sim::TriMesh frame(int k) const {
    sim::Remarks remarks;
    return sim::read_tri_mesh(at("run/export/frame_000" + std::to_string(k) + ".ply"), remarks);
  }
};

std::vector<double> flat(const sim::Points& X) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < X.rows(); ++i)
    for (int c = 0; c < 3; ++c) values.push_back(X(i, c));
  return values;
}

std::vector<std::uint32_t> flat(const std::vector<sim::Triangle>& triangles) {
  std::vector<std::uint32_t> values;
  for (const sim::Triangle& t : triangles)
    for (int i = 0; i < 3; ++i) values.push_back(static_cast<std::uint32_t>(t[static_cast<std::size_t>(i)]));
  return values;
}

template <class T>
void expect_near(const std::vector<T>& values, const std::vector<double>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], expected[i], kRounding) << i;
}

TEST_F(ExportSequence, CountsFramesWhateverItsPasses) {
  expect(0, simulate("run"));
  for (const char* format : {"gltf", "usda"}) {
    const Ended ended = run_program({"export", at("run").string(), "--format", format});
    EXPECT_NE(ended.err.find("frame 4 of 4, "), std::string::npos) << ended.err;
  }
}

TEST_F(ExportSequence, GltfMovesByMorphTargets) {
  expect(0, simulate("run"));
  exported("ply");
  EXPECT_EQ(exported("gltf", {"--frames", "1..3"})["files"], Json::parse(R"(["bar.glb"])"));
  const Glb glb(read_all(at("run/export/bar.glb")));
  const Json& primitive = glb.json["meshes"].at(0)["primitives"].at(0);
  EXPECT_EQ(glb.values<std::uint32_t>(primitive["indices"]), flat(frame(1).triangles));
  const std::vector<float> base = glb.values<float>(primitive["attributes"]["POSITION"]);
  const std::vector<float> normals = glb.values<float>(primitive["attributes"]["NORMAL"]);
  expect_near(base, flat(frame(1).X));
  ASSERT_EQ(primitive["targets"].size(), 2U);
  for (int k = 0; k < 2; ++k) {
    const Json& target = primitive["targets"].at(static_cast<std::size_t>(k));
    std::vector<float> moved = glb.values<float>(target["POSITION"]);
    std::vector<float> turned = glb.values<float>(target["NORMAL"]);
    EXPECT_NE(moved, std::vector<float>(moved.size(), 0.0F));
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += base[i];
    expect_near(moved, flat(frame(2 + k).X));
    for (std::size_t i = 0; i < turned.size(); i += 3)
      ASSERT_NEAR(
          std::hypot(turned[i] + normals[i], turned[i + 1] + normals[i + 1], turned[i + 2] + normals[i + 2]),
          1.0F, 1e-6F);
  }
  for (const char* key : {"POSITION"})  // bounds are demanded of these
    for (const Json& target : primitive["targets"])
      EXPECT_TRUE(glb.json["accessors"].at(target[key].get<std::size_t>()).contains("max"));
  EXPECT_EQ(glb.json["meshes"][0]["weights"], Json::parse("[0, 0]"));
  EXPECT_EQ(glb.json["meshes"][0]["extras"]["targetNames"], Json::parse(R"(["frame_0002", "frame_0003"])"));
  const Json& sampler = glb.json["animations"].at(0)["samplers"].at(0);
  EXPECT_EQ(glb.json["animations"][0]["channels"],
            Json::parse(R"([{"sampler": 0, "target": {"node": 0, "path": "weights"}}])"));
  EXPECT_EQ(glb.values<float>(sampler["input"]),
            (std::vector<float>{0.0F, static_cast<float>(1 / 30.0), static_cast<float>(2 / 30.0)}));
  EXPECT_TRUE(glb.json["accessors"].at(sampler["input"].get<std::size_t>()).contains("max"));
  EXPECT_EQ(glb.values<float>(sampler["output"]), (std::vector<float>{0, 0, 1, 0, 0, 1}));
}

TEST_F(ExportSequence, GltfHasLookAndCamera) {
  expect(0, simulate("run", {"--set", "body.0.look.base_color=[0.25, 0.5, 0.75]", "--set",
                             "body.0.look.metallic=1.0", "--set", "body.0.look.roughness=0.25", "--set",
                             "body.0.surface.smooth=false"}));
  exported("gltf", {"--frames", "2"});
  const Glb glb(read_all(at("run/export/bar.glb")));
  EXPECT_EQ(
      glb.json["materials"].at(0)["pbrMetallicRoughness"],
      Json::parse(
          R"({"baseColorFactor": [0.25, 0.5, 0.75, 1], "metallicFactor": 1.0, "roughnessFactor": 0.25})"));
  EXPECT_FALSE(glb.json["meshes"].at(0)["primitives"].at(0)["attributes"].contains("NORMAL"));  // flat
  EXPECT_FALSE(glb.json["meshes"][0]["primitives"][0].contains("targets"));
  EXPECT_FALSE(glb.json.contains("animations"));
  const Json& camera = glb.json["cameras"].at(0);
  EXPECT_EQ(camera["type"], "perspective");
  EXPECT_NEAR(camera["perspective"]["yfov"].get<double>(), 35.0 * M_PI / 180.0, 1e-12);
  EXPECT_NEAR(camera["perspective"]["aspectRatio"].get<double>(), 64.0 / 48.0, 1e-12);
  const Json& node = glb.json["nodes"].at(1);  // at (0, 0.4, 2), looking at (0, 0.3, 0): turned about x alone
  EXPECT_NEAR(node["translation"][2].get<double>(), 2.0, 1e-7);
  EXPECT_NEAR(node["rotation"][0].get<double>(), std::sin(-std::atan2(0.1, 2.0) / 2), 1e-6);
  EXPECT_NEAR(node["rotation"][1].get<double>(), 0.0, 1e-6);
}

/// Those of one frame in the range of all states, linear as the pictures': by default the exported one that
/// shows most of the range, of a bar that begins to fall the last.
TEST_F(ExportSequence, GltfHasTheColorsOfAField) {
  const Arguments field = {"--set", "body.0.look={ field = 'displacement', base_color = [0.25, 0.5, 0.75] }"};
  expect(0, simulate("run", field));
  for (const Arguments& asked : {Arguments{"--frames", "0..1", "--color-frame", "0"},
                                 Arguments{"--frames", "3"}, Arguments{"--frames", "0..3"}, Arguments{}}) {
    EXPECT_EQ(exported("gltf", asked)["color_frame"], asked.size() < 4 ? 3 : 0);
    const Glb glb(read_all(at("run/export/bar.glb")));
    const Json& primitive = glb.json["meshes"].at(0)["primitives"].at(0);
    const std::vector<float> colors = glb.values<float>(primitive["attributes"]["COLOR_0"]);
    ASSERT_EQ(colors.size(), glb.values<float>(primitive["attributes"]["POSITION"]).size());
    EXPECT_EQ(glb.json["materials"].at(0)["pbrMetallicRoughness"]["baseColorFactor"],
              Json::parse("[1.0, 1.0, 1.0, 1.0]"));
    const render::Color first = render::color_of(render::find_colormap("viridis"), 0.0F),
                        last = render::color_of(render::find_colormap("viridis"), 1.0F);
    float from_first = 0.0F, to_last = 1.0F;
    for (std::size_t i = 0; i < colors.size(); i += 3) {
      const render::Color c(colors[i], colors[i + 1], colors[i + 2]);
      from_first = std::max(from_first, (c - first).abs().maxCoeff());
      to_last = std::min(to_last, (c - last).abs().maxCoeff());
    }
    if (asked.size() < 4) {
      EXPECT_LT(to_last, 1e-5F) << "the furthest of all frames";
      EXPECT_GT(from_first, 0.5F);
    } else {
      EXPECT_LT(from_first, 1e-6F) << "nothing has moved in frame 0";
    }
  }
  for (const auto& [asked, told] :
       {std::pair(Arguments{}, "displacement of frame 3 throughout"),
        std::pair(Arguments{"--color-frame", "1"}, "displacement of frame 1 throughout")}) {
    const std::string said =
        run_program(Arguments{"export", at("run").string(), "--format", "gltf"} + asked).err;
    EXPECT_NE(said.find("colours of " + std::string(told)), std::string::npos) << said;
  }
  expect(0, simulate("plain"));
  expect(0, {"export", at("plain").string(), "--format", "gltf", "--quiet"});
  EXPECT_EQ(Glb(read_all(at("plain/export/bar.glb"))).json.dump().find("COLOR_0"), std::string::npos);
  const std::string run = at("run").string(), plain = at("plain").string();
  expect(2, {"export", run, "--format", "usda", "--color-frame", "1"});
  expect(2, {"export", run, "--format", "gltf", "--color-frame", "9"});
  expect(2, {"export", plain, "--format", "gltf", "--color-frame", "1"});
}

/// Numbers that single precision holds exactly. The names are those of the extensions' specifications.
TEST_F(ExportSequence, GltfHasTheLookOfTheKhronosExtensions) {
  expect(0, simulate("run", Arguments{"--set",
                                      "body.0.look={ base_color = [0.25, 0.5, 0.75], opacity = 0.5, "
                                      "transmission = 0.5, absorption_color = [1, 0.5, 0.25], "
                                      "absorption_distance = 0.125, coat = 0.75, coat_roughness = "
                                      "0.25, sheen = 0.5, sheen_tint = [1, 0.5, 0.25], "
                                      "sheen_roughness = 0.375 }"}));
  exported("gltf", {"--frames", "2"});
  exported("ply", {"--frames", "2"});
  const Glb glb(read_all(at("run/export/bar.glb")));
  Json material = glb.json["materials"].at(0);
  EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"], Json::parse("[0.625, 0.75, 0.875, 0.5]"))
      << "half of it clear, half of it there";
  EXPECT_EQ(material["alphaMode"], "BLEND");
  Json& extensions = material["extensions"];
  const double thickness = extensions["KHR_materials_volume"]["thicknessFactor"].get<double>();
  const sim::Points X = frame(2).X;
  EXPECT_NEAR(thickness, (X.colwise().maxCoeff() - X.colwise().minCoeff()).minCoeff(), kRounding);
  EXPECT_GT(thickness, 0.01);
  extensions["KHR_materials_volume"].erase("thicknessFactor");
  EXPECT_EQ(extensions, Json::parse(R"({
    "KHR_materials_transmission": {"transmissionFactor": 0.5},
    "KHR_materials_volume": {"attenuationColor": [1.0, 0.5, 0.25], "attenuationDistance": 0.125},
    "KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25},
    "KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.25, 0.125], "sheenRoughnessFactor": 0.375}})"));
  EXPECT_EQ(glb.json["extensionsUsed"],
            Json::parse(R"(["KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_clearcoat",
                            "KHR_materials_sheen"])"));
}

TEST_F(ExportSequence, GltfUsesNoExtensionInVain) {
  const auto material = [&](const char* name, const std::string& look) {
    expect(0, simulate(name, {"--frames", "0", "--set", "body.0.look={ " + look + " }"}));
    expect(0, {"export", at(name).string(), "--format", "gltf", "--quiet"});
    const Glb glb(read_all(at(name) / "export/bar.glb"));
    Json material = glb.json["materials"].at(0);
    std::vector<std::string> used;  // each once, in no order that matters
    if (material.contains("extensions"))
      for (const auto& [extension, members] : material["extensions"].items()) used.push_back(extension);
    std::vector<std::string> told = glb.json.value("extensionsUsed", std::vector<std::string>());
    std::sort(told.begin(), told.end());
    EXPECT_EQ(told, used);
    return material;
  };
  EXPECT_EQ(material("plain", "").size(), 3U) << "name, pbrMetallicRoughness and doubleSided";
  EXPECT_FALSE(material("metal", "metallic = 1, transmission = 1").contains("extensions"));
  EXPECT_EQ(material("ior", "ior = 1.25")["extensions"],
            Json::parse(R"({"KHR_materials_ior": {"ior": 1.25}})"));
  const Json clear = material("clear", "transmission = 1");
  EXPECT_FALSE(clear.contains("alphaMode")) << "which is for what is not there";
  EXPECT_FALSE(clear.contains("doubleSided")) << "the validator warns of it with a volume";
  EXPECT_EQ(clear["pbrMetallicRoughness"]["baseColorFactor"], Json::parse("[1, 1, 1, 1]"));
  EXPECT_EQ(clear["extensions"]["KHR_materials_volume"].size(), 1U) << "it absorbs nothing";
  EXPECT_EQ(
      material(
          "cloudy",
          "subsurface = 1, subsurface_color = [1, 0.5, 0.25]")["pbrMetallicRoughness"]["baseColorFactor"],
      Json::parse("[1, 0.5, 0.25, 1]"));
}

TEST_F(ExportSequence, UsdHasSamplesByFrame) {
  expect(0, simulate("run"));
  exported("ply", {"--fields", "von_mises"});
  exported("usda", {"--frames", "1..3", "--fields", "von_mises"});
  const std::string usd = read_all(at("run/export/bar.usda"));
  EXPECT_TRUE(usd.starts_with("#usda 1.0\n"));
  for (const char* line :
       {"upAxis = \"Y\"", "metersPerUnit = 1", "timeCodesPerSecond = 30", "startTimeCode = 1",
        "endTimeCode = 3", "subdivisionScheme = \"none\"", "def Camera \"camera\""})
    EXPECT_NE(usd.find(line), std::string::npos) << line;
  EXPECT_EQ(std::count(usd.begin(), usd.end(), '{'), std::count(usd.begin(), usd.end(), '}'));
  const auto numbers_after = [&](const std::string& attribute, const std::string& label) {
    const std::size_t begin = usd.find(label, usd.find(attribute));
    const std::size_t end = usd.find('\n', begin);
    std::string list = usd.substr(begin + label.size(), end - begin - label.size());
    std::replace_if(
        list.begin(), list.end(),
        [](char c) { return std::string_view("[](),").find(c) != std::string_view::npos; }, ' ');
    std::istringstream words(list);
    return std::vector<double>(std::istream_iterator<double>(words), {});
  };
  const std::vector<std::uint32_t> triangles = flat(frame(1).triangles);
  const std::vector<double> corners = numbers_after("int[] faceVertexIndices", " = ");
  EXPECT_EQ(std::vector<std::uint32_t>(corners.begin(), corners.end()), triangles);
  EXPECT_EQ(numbers_after("int[] faceVertexCounts", " = "), std::vector<double>(triangles.size() / 3, 3.0));
  for (int k = 1; k <= 3; ++k) {
    const std::string label = " " + std::to_string(k) + ": ";
    const sim::Points X = frame(k).X;
    expect_near(numbers_after("points.timeSamples", label), flat(X));
    const std::vector<double> extent = numbers_after("extent.timeSamples", label);
    ASSERT_EQ(extent.size(), 6U);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(extent[static_cast<std::size_t>(c)], X.col(c).minCoeff(), kRounding);
      EXPECT_NEAR(extent[static_cast<std::size_t>(c + 3)], X.col(c).maxCoeff(), kRounding);
    }
    EXPECT_EQ(numbers_after("normals.timeSamples", label).size(), static_cast<std::size_t>(3 * X.rows()));
    const std::vector<double> stresses = numbers_after("primvars:von_mises.timeSamples", label);
    EXPECT_EQ(stresses.size(), static_cast<std::size_t>(X.rows()));
    EXPECT_GT(*std::max_element(stresses.begin(), stresses.end()), 0.0);
  }
}

TEST_F(ExportSequence, UsdHasTheLookOfAPreviewSurface) {
  const auto exported = [&](const char* name, const std::string& look) {
    expect(0, simulate(name, {"--frames", "0", "--set", "body.0.look={ " + look + " }"}));
    expect(0, {"export", at(name).string(), "--format", "usda", "--quiet"});
    return read_all(at(name) / "export/bar.usda");
  };
  const std::string coated = exported("coated",
                                      "base_color = [0.25, 0.5, 0.75], ior = 1.25, coat = 0.75, "
                                      "coat_roughness = 0.125, opacity = 0.5");
  for (const char* line : {"color3f inputs:diffuseColor = (0.25, 0.5, 0.75)\n", "float inputs:ior = 1.25\n",
                           "float inputs:clearcoat = 0.75\n", "float inputs:clearcoatRoughness = 0.125\n",
                           "float inputs:opacity = 0.5\n", "token inputs:opacityMode = \"presence\"\n",
                           "color3f[] primvars:displayColor = [(0.25, 0.5, 0.75)] (\n",
                           "float[] primvars:displayOpacity = [0.5] (\n"})
    EXPECT_NE(coated.find(line), std::string::npos) << line;
  const std::string plain = exported("plain", "base_color = [0.25, 0.5, 0.75]");
  for (const char* word : {"clearcoat", "pacity"}) EXPECT_EQ(plain.find(word), std::string::npos) << word;
  const std::string jelly = exported("jelly", "transmission = 1, absorption_color = [1, 0.5, 0.25]");
  EXPECT_EQ(jelly.find("pacity"), std::string::npos) << "it is there";
  EXPECT_NE(jelly.find("inputs:diffuseColor = (1, 0.5, 0.25)\n"), std::string::npos);
}

TEST_F(ExportSequence, WhatIsLeftOutOfALookIsTold) {
  const auto said = [&](const std::string& format) {
    const Ended ended = run_program({"export", at("run").string(), "--format", format});
    EXPECT_EQ(ended.status, 0);
    return ended.err;
  };
  expect(0, simulate("run", {"--frames", "0", "--set",
                             "body.0.look={ transmission = 0.5, subsurface = 0.5, sheen = 0.5, coat = 0.5, "
                             "opacity = 0.5, field = 'J' }"}));
  EXPECT_NE(said("gltf").find(
                "gltf: subsurface (an opaque base of subsurface_color) of body 'bar' is left out\n"
                "gltf: body 'bar' keeps the colours of J of frame 0 throughout; glTF has none that move\n"),
            std::string::npos);
  EXPECT_NE(
      said("usda").find("usda: transmission (an opaque base of absorption_color), sheen, subsurface (an "
                        "opaque base of subsurface_color), the colours of J of body 'bar' are left out\n"),
      std::string::npos);
  EXPECT_EQ(said("ply").find("left out"), std::string::npos) << "it has no look at all";
  std::filesystem::remove_all(at("run"));
  expect(0, simulate("run",
                     {"--frames", "0", "--set", "body.0.look={ sheen = 0.5, coat = 0.5, opacity = 0.5 }"}));
  EXPECT_EQ(said("gltf").find("left out"), std::string::npos);
  EXPECT_NE(said("usda").find("usda: sheen of body 'bar' is left out\n"), std::string::npos);
}

/// A turntable of eight frames, of which these are three: a quarter of a turn in two.
TEST_F(ExportSequence, TheCameraMovesAsInThePictures) {
  expect(0, simulate("run",
                     {"--set", "time.frames=8", "--set", "camera.turntable.turns=1", "--set",
                      "camera.position=[0,0.3,2]", "--set", "camera.look_at=[0,0.3,0]", "--frames", "0..3"}));
  exported("gltf", {"--frames", "1..3"});
  const Glb glb(read_all(at("run/export/bar.glb")));
  const Json& animation = glb.json["animations"].at(0);
  ASSERT_EQ(animation["channels"].size(), 3U);
  EXPECT_EQ(animation["channels"][1]["target"], Json::parse(R"({"node": 1, "path": "translation"})"));
  EXPECT_EQ(animation["channels"][2]["target"], Json::parse(R"({"node": 1, "path": "rotation"})"));
  const std::vector<float> to = glb.values<float>(animation["samplers"].at(1)["output"]),
                           turned = glb.values<float>(animation["samplers"].at(2)["output"]);
  ASSERT_EQ(to.size(), 9U);
  ASSERT_EQ(turned.size(), 12U);
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = (static_cast<double>(k) + 1.0) * M_PI / 4;  // about +y, and so does it look
    EXPECT_NEAR(to[3 * k], 2.0 * std::sin(angle), 1e-6);
    EXPECT_NEAR(to[3 * k + 1], 0.3, 1e-6);
    EXPECT_NEAR(to[3 * k + 2], 2.0 * std::cos(angle), 1e-6);
    EXPECT_NEAR(turned[4 * k + 1], std::sin(angle / 2), 1e-6);
    EXPECT_NEAR(turned[4 * k + 3], std::cos(angle / 2), 1e-6);
  }
  EXPECT_EQ(glb.json["nodes"].at(1)["translation"][0].get<float>(), to[0]) << "the first frame's";

  exported("usda", {"--frames", "1..3"});
  const std::string usd = read_all(at("run/export/bar.usda"));
  const std::size_t begin = usd.find("matrix4d xformOp:transform.timeSamples = {");
  ASSERT_NE(begin, std::string::npos);
  const std::string samples = usd.substr(begin, usd.find('}', begin) - begin);
  for (const char* frame : {" 1: ( (", " 2: ( (", " 3: ( ("})
    EXPECT_NE(samples.find(frame), std::string::npos) << samples;
  EXPECT_NE(samples.find("(2, 0.3, "), std::string::npos) << samples;
  EXPECT_NE(usd.find("float focalLength = "), std::string::npos) << "the same in all frames";
}

TEST_F(ExportSequence, AZoomIsInUsdAndToldOfGltf) {
  expect(0, simulate("run", {"--set", "camera.key=[{ frame = 0, fov = 40 }, { frame = 3, fov = 20 }]"}));
  exported("usda");
  const std::string usd = read_all(at("run/export/bar.usda"));
  EXPECT_NE(usd.find("float focalLength.timeSamples = {\n            0: 32.9697"), std::string::npos)
      << "12 mm / tan(20 degrees)";
  EXPECT_NE(usd.find("            3: 68.0553"), std::string::npos);
  const Ended ended = run_program({"export", at("run").string(), "--format", "gltf"});
  EXPECT_NE(ended.err.find("the camera keeps its field of view of frame 0 in a .glb"), std::string::npos)
      << ended.err;
}

TEST(PrimNames, AreIdentifiersAndEachItsOwn) {
  EXPECT_EQ(apps::prim_names({"bar", "2nd bar", "ear.left", "bar", "", "ear left"}),
            (std::vector<std::string>{"bar", "_2nd_bar", "ear_left", "bar_2", "_", "ear_left_2"}));
}

TEST_F(ExportSequence, HasTheSameBytesForAnyThreads) {
  expect(0, simulate("run"));
  for (const char* format : {"gltf", "usda"})
    for (const char* threads : {"1", "3"})
      exported(format, {"--threads", threads, "-o", at(threads).string()});
  EXPECT_EQ(tree(at("1")), tree(at("3")));
  EXPECT_EQ(count_files(at("1")), 2);
}

TEST_F(ExportSequence, AFileThatCannotBeWrittenLeavesNone) {
  expect(0, simulate("run"));
  for (const char* format : {"gltf", "usda"}) {
    const std::string error =
        expect(4, {"export", at("run").string(), "--quiet", "--format", format}, {.largest_file = 1000});
    EXPECT_NE(error.find("File too large"), std::string::npos) << error;
    EXPECT_EQ(count_files(at("run/export")), 0);
  }
}

}  // namespace sequence_test
}  // namespace lagomorph::tests
