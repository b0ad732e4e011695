#include <set>

#include "apps/npy.h"
#include "tests/support/check_fixture.h"
#include "tests/support/png_maker.h"

/// `lagomorph check` as scripts see it.
namespace lagomorph::tests {
namespace check_command_test {

using Json = nlohmann::json;
using CheckCommand = CheckFixture;

std::string plus(int n) {
  return changed_png("spheres_ref.png", [n](double v, std::size_t) { return v + n; });
}

TEST_F(CheckCommand, FailuresHaveNamesOfTheirOwn) {
  const std::string good = flip_file("edge_ref.png");
  PngSpec deep{.width = 101, .height = 67, .depth = 16};
  deep.samples.assign(101 * 67 * 3, 700);
  PngSpec grey{.width = 101, .height = 67, .color_type = 0};
  grey.samples.assign(101 * 67, 7);
  for (int frame = 0; frame < 9; ++frame) {
    if (frame != 2) add_golden(frame, frame == 7 ? "no picture" : good);
  }
  add_run(0, good);
  add_run(2, good);
  add_run(3, good.substr(0, good.size() / 2));
  add_run(4, flip_file("black.png"));
  add_run(5, make_png(deep));
  add_run(6, make_png(grey));
  add_run(7, good);
  add_run(8, flip_file("edge_aa.png"));
  const Json json = report(1);
  EXPECT_EQ(rules(json), Json::parse(R"({"1": ["missing"], "2": ["extra"], "3": ["unreadable"], "4": ["size"],
                                        "5": ["bit_depth"], "6": ["channels"], "7": ["unreadable"]})"));
  EXPECT_EQ(json["frames"][0]["decided_by"], "bytes");
  EXPECT_EQ(json["frames"][4]["failures"][0]["found"], "101x67 against 64x48 (golden, new)");
  EXPECT_EQ(json["counts"], Json::parse(R"({"frames": 9, "failed": 7})"));
  EXPECT_EQ(json["sequence"], Json::parse(R"({"first_bad": 1, "bad": [[1, 7]], "findings": []})"));
}

TEST_F(CheckCommand, OddPicturesAreComparedRightlyOrTold) {
  const auto make = [](PngSpec spec, unsigned step) {
    spec.width = 40, spec.height = 30;
    for (unsigned i = 0; i < 40 * 30; ++i) {
      for (int c = 0; c < spec.stored_channels(); ++c) spec.samples.push_back(i * 13 / 7 % 4 * step);
    }
    return make_png(spec);
  };
  const std::string rgb = make({}, 85), interlaced = make({.interlaced = true}, 85);
  const std::string palette =
      make({.depth = 2, .color_type = 3, .palette = std::string("\0\0\0UUU\xAA\xAA\xAA\xFF\xFF\xFF", 12)}, 1);
  const std::string deep = make({.depth = 16}, 0x5555), grey = make({.color_type = 0}, 85);
  const std::string huge = png_signature + png_header({.width = 2000000000, .height = 2000000000}) +
                           png_chunk("IDAT", "x") + png_chunk("IEND", "");
  const struct {
    std::string golden, fresh, rule, how;
  } cases[] = {
      {rgb, interlaced, "", "pixels"},
      {interlaced, palette, "", "pixels"},
      {deep, deep, "", "bytes"},
      {grey, grey, "", "bytes"},
      {deep, make({.depth = 16}, 0x5554), "", "metrics"},
      {grey, make({.color_type = 0}, 60), "flip_tile_max", "metrics"},
      {rgb, make({}, 60), "flip_tile_max", "metrics"},
      {palette, grey, "channels", "nothing"},
      {flip_file("one_a.png"), flip_file("one_a.png"), "", "bytes"},
      {flip_file("one_a.png"), flip_file("one_b.png"), "flip_tile_max", "metrics"},
      {flip_file("one_a.png"), rgb, "size", "nothing"},
      {rgb, huge, "unreadable", "nothing"},
      {huge, huge, "unreadable", "nothing"},
      {rgb, rgb.substr(0, rgb.size() - 1), "unreadable", "nothing"},
      {rgb, "", "unreadable", "nothing"},
  };
  int frame = 0;
  for (const auto& c : cases) {
    add_golden(frame, c.golden);
    add_run(frame++, c.fresh);
  }
  const Json json = report(1);
  for (std::size_t i = 0; i < std::size(cases); ++i) {
    const Json& told = json["frames"][i];
    EXPECT_EQ(told["decided_by"], cases[i].how) << told;
    EXPECT_EQ(told["failures"].empty(), cases[i].rule.empty()) << told;
    if (!cases[i].rule.empty() && !told["failures"].empty()) {
      EXPECT_EQ(told["failures"][0]["rule"], cases[i].rule) << told;
    }
  }
}

TEST_F(CheckCommand, AFailureNamesRuleFigureLimitAndWhereItCameFrom) {
  limits("preset = \"render\"\n[limits]\nflip_mean = 0.001\nflip_tile_max = \"off\"\n");
  add_golden(0, flip_file("spheres_ref.png"));
  add_run(0, flip_file("spheres_moved.png"));
  const std::string toml = at("golden/golden.toml").string();
  EXPECT_NE(check().out.find("frame 0: flip_mean 0.007046, limit 0.001 by " + toml + ":3:13\n"),
            std::string::npos)
      << check().out;
  EXPECT_NE(
      check({"--set", "limits.flip_mean=0.002"}).out.find("limit 0.002 by --set limits.flip_mean=0.002\n"),
      std::string::npos);
  EXPECT_NE(check({"--preset", "lsb"}).out.find("max_abs 0.6275, limit 0.003922 by preset lsb (--preset)\n"),
            std::string::npos);
  EXPECT_EQ(check({"--set", "limits.flip_mean=0.02"}).status, 0);
}

TEST_F(CheckCommand, RangesOfFramesHaveLimitsOfTheirOwn) {
  limits(
      "[[range]]\nframes = \"1..2\"\npreset = \"exact\"\n[[range]]\nframes = 2\nlimits = { max_abs = 0.01 "
      "}\n");
  for (int frame = 0; frame < 4; ++frame) {
    add_golden(frame, flip_file("spheres_ref.png"));
    add_run(frame, plus(1));
  }
  const Json json = report(1);
  EXPECT_EQ(rules(json), Json::parse(R"({"1": ["max_abs"]})"));
  EXPECT_EQ(json["frames"][1]["failures"][0]["from"],
            "preset exact (" + at("golden/golden.toml").string() + ":3:10)");
}

TEST_F(CheckCommand, NoPairAtAllIsAnError) {
  add_golden(0, flip_file("one_a.png"));
  EXPECT_NE(refusal().find("there is no such run"), std::string::npos);
  add_run(1, flip_file("one_a.png"));
  EXPECT_NE(refusal().find("has pictures of frames 1, "), std::string::npos);
  add_run(0, flip_file("one_a.png"));
  EXPECT_NE(refusal({"--frames", "1"}).find("only 1..1 are asked for"), std::string::npos);
  EXPECT_NE(refusal({"--frames", "0..7"}).find("the last frame"), std::string::npos);
  EXPECT_EQ(check({"--frames", "0"}).status, 0);
}

TEST_F(CheckCommand, WrongGoldensAreRefusedWithTheirPlace) {
  add_run(0, flip_file("one_a.png"));
  EXPECT_NE(refusal().find("there is no such golden"), std::string::npos);
  add_golden(0, flip_file("one_a.png"));
  const struct {
    const char *toml, *message;
  } wrong[] = {
      {"presett = \"exact\"\n", ":1:1: unknown key 'presett'; did you mean 'preset'?"},
      {"preset = \"exactly\"\n", ":1:10: unknown preset 'exactly'; did you mean 'exact'?"},
      {"[limits]\nflip_meen = 1\n", ":2:1: unknown key 'flip_meen'; did you mean 'flip_mean'?"},
      {"[limits]\nflip_mean = -1\n", ":2:13: limits.flip_mean = -1 is out of range; it must be in 0 .. 1"},
      {"[limits]\nflip_mean = \"none\"\n", ":2:13: limits.flip_mean must be a number or \"off\""},
      {"[[range]]\npreset = \"mc\"\n", ":1:1: range.0.frames is missing"},
      {"[[range]]\nframes = \"5..3\"\n", ":2:10: range.0.frames = 5..3: the first frame, 5, is after"},
      {"[[mask]]\nframes = 3\n", ":1:1: mask.0 must have either png, rectangle or body_id"},
      {"[[mask]]\nrectangle = [1, 2, 3]\n", "mask.0.rectangle must be [x, y, width, height] in pixels"},
      {"[[mask]]\npng = \"none.png\"\n", "none.png: cannot be read"},
      {"keep_every = 0\n", "keep_every = 0 is out of range"},
      {"a b\n", ":1:3: "},
  };
  for (const auto& w : wrong) {
    limits(w.toml);
    EXPECT_NE(refusal().find(w.message), std::string::npos) << w.toml << refusal();
  }
  limits("");
  EXPECT_NE(refusal({"--set", "limits.flip=1"}).find("--set limits.flip=1: unknown key 'flip'"),
            std::string::npos);
  EXPECT_NE(refusal({"--variant", "mac"}).find("--variant mac: "), std::string::npos);
}

TEST_F(CheckCommand, FoldersOfPicturesNeedNoRun) {
  dir_.write("run/shot-007.png", flip_file("one_a.png"));
  dir_.write("run/cover.png", flip_file("one_a.png"));
  dir_.write("golden/7.PNG", flip_file("one_a.png"));
  const Json json = report(0);
  EXPECT_EQ(json["frames"][0]["frame"], 7);
  ASSERT_EQ(json["remarks"].size(), 1U);
  EXPECT_NE(json["remarks"][0].get<std::string>().find("without a number left out, as cover.png"),
            std::string::npos);
  dir_.write("run/other_7.png", flip_file("one_a.png"));
  const Ended ended = check();
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("other_7.png and shot-007.png are both frame 7"), std::string::npos) << ended.err;
}

TEST_F(CheckCommand, MasksLeavePixelsOutAndTellTheirShare) {
  add_golden(0, flip_file("spheres_ref.png"));
  add_run(0, flip_file("spheres_moved.png"));
  EXPECT_EQ(check().status, 1);
  limits("[[mask]]\nrectangle = [128, 64, 128, 96]\n");
  const Ended ended = check();
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("masked: 21.33 % of every picture\n"), std::string::npos) << ended.out;
  EXPECT_DOUBLE_EQ(report(0)["frames"][0]["masked"].get<double>(), 128.0 * 96 / (320 * 180));

  render::Picture picture{320, 180, std::vector<std::uint8_t>(3 * 320 * 180, 0)};
  for (int y = 64; y < 160; ++y)
    std::fill_n(picture.rgb.begin() + 3 * (320 * y + 128), 3 * 128, std::uint8_t{255});
  dir_.write("golden/mask.png", render::encode_png(picture, 1));
  limits("[[mask]]\npng = \"mask.png\"\nframes = \"0..3\"\n");
  EXPECT_EQ(check().status, 0);
  limits("[[mask]]\npng = \"mask.png\"\nframes = 1\n");
  EXPECT_EQ(check().status, 1);
  limits("[[mask]]\nrectangle = [0, 0, 9999, 9999]\n");
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"0": ["mask"]})"));
  dir_.write("golden/mask.png", flip_file("one_a.png"));
  limits("[[mask]]\npng = \"mask.png\"\n");
  EXPECT_NE(
      report(1)["frames"][0]["failures"][0]["found"].get<std::string>().find("is 1x1, the picture 320x180"),
      std::string::npos);
}

TEST_F(CheckCommand, AMaskMayBeABodyOfTheGoldensOwnChannel) {
  add_run(0, flip_file("spheres_moved.png"));
  add_golden(0, flip_file("spheres_ref.png"));
  limits("[[mask]]\nbody_id = 2\n");
  const Json none = report(1)["frames"][0]["failures"][0];
  EXPECT_EQ(none["rule"], "mask");
  EXPECT_NE(none["line"].get<std::string>().find("approve takes it from a run with render.channels"),
            std::string::npos)
      << none;
  std::vector<float> ids(320 * 180, -1);
  for (std::size_t y = 64; y < 160; ++y)
    std::fill_n(ids.begin() + static_cast<std::ptrdiff_t>(320 * y + 128), 128, 2.0F);
  const std::vector<std::size_t> shape = {180, 320};
  const std::string channel = apps::npy_bytes(ids, shape);
  dir_.write("golden/aov/body_id/frame_0000.npy", channel);
  const Ended ended = check();
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("masked: 21.33 % of every picture\n"), std::string::npos) << ended.out;
  limits("[[mask]]\nbody_id = 1\n");
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"0": ["flip_tile_max"]})"));
  ids.pop_back();
  dir_.write("golden/aov/body_id/frame_0000.npy", apps::npy_bytes(ids, std::vector<std::size_t>{ids.size()}));
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"0": ["mask"]})"));
  // Approving takes the run's channel along.
  dir_.write("run/aov/body_id/frame_0000.npy", channel);
  EXPECT_EQ(run_program({"approve", at("run").string(), at("golden").string()}).status, 0);
  EXPECT_EQ(read_all(at("golden/aov/body_id/frame_0000.npy")), channel);
}

TEST_F(CheckCommand, AlphaIsCompared) {
  PngSpec opaque{.width = 20, .height = 20, .color_type = 6}, clear = opaque;
  for (int i = 0; i < 400; ++i) {
    for (const unsigned v : {10U, 20U, 30U, 255U}) opaque.samples.push_back(v);
    for (const unsigned v : {10U, 20U, 30U, 90U}) clear.samples.push_back(v);
  }
  add_golden(0, make_png(opaque));
  add_run(0, make_png(clear));
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"0": ["alpha_tile_max", "alpha_mean"]})"));
  EXPECT_EQ(rules(report(1, {"--preset", "exact"})), Json::parse(R"({"0": ["alpha_max_abs"]})"));
}

TEST_F(CheckCommand, FlickerIsSeenThatEverySingleFramePasses) {
  for (int frame = 0; frame < 6; ++frame) {
    add_golden(frame, flip_file("spheres_ref.png"));
    add_run(frame, plus(frame % 2 == 0 ? 1 : -1));
  }
  const Json json = report(1);
  const auto flicker = Json::array({"flicker_mean"});
  EXPECT_EQ(rules(json),
            (Json{{"1", flicker}, {"2", flicker}, {"3", flicker}, {"4", flicker}, {"5", flicker}}));
  EXPECT_FALSE(json["frames"][1]["heat"].is_null());
  for (int frame = 0; frame < 6; ++frame) add_run(frame, plus(1));  // a difference that stays is none
  EXPECT_EQ(check().status, 0);
}

TEST_F(CheckCommand, WhatComesBackAfterABadFrameIsNoNews) {
  for (int frame = 0; frame < 3; ++frame) {
    add_golden(frame, flip_file("spheres_ref.png"));
    add_run(frame, flip_file(frame == 1 ? "spheres_missing.png" : "spheres_ref.png"));
  }
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"1": ["flip_tile_max"]})"));
}

TEST_F(CheckCommand, TellsThatFramesAreLate) {
  const auto frame = [](int k) { return shifted_png("spheres_ref.png", 8 * k, 0); };
  for (int k = 0; k < 7; ++k) {
    add_golden(k, frame(k));
    add_run(k, frame(k < 2 || k == 6 ? k : k + 1));
  }
  const Json json = report(1);
  EXPECT_EQ(json["sequence"]["first_bad"], 2);
  EXPECT_EQ(json["sequence"]["bad"], Json::parse("[[2, 5]]"));
  EXPECT_EQ(
      json["sequence"]["findings"],
      Json::parse(
          R"([{"kind": "time_shift", "frames": [2, 5], "text": "matches the golden's frame + 1 from frame 2 to 5"}])"));
  EXPECT_EQ(json["frames"][2]["hints"][0], "matches the golden's frame 3");
}

TEST_F(CheckCommand, TellsWhatAPictureLooksLike) {
  const std::string ref = "spheres_ref.png";
  const struct {
    std::string png, hint;
  } looks[] = {
      {shifted_png(ref, 1, 0), "shifted by 1 pixel to the right"},
      {shifted_png(ref, -2, -1), "shifted by 2 pixels to the left and 1 pixel up"},
      {changed_png(ref, [](double v, std::size_t i) { return i % 3 == 2 ? 0.85 * v : v; }),
       "only the tones differ: blue times 0.85"},
      {changed_png(ref, [](double v, std::size_t) { return 255 * std::pow(v / 255, 1 / 1.1); }),
       "only the tones differ: gamma 1.1"},
      {changed_png(ref, [](double v, std::size_t) { return v - 20; }), "only the tones differ: -20 of 255"},
  };
  int frame = 0;
  for (const auto& look : looks) {
    add_golden(10 * frame, flip_file(ref));
    add_run(10 * frame, look.png);
    ++frame;
  }
  const Json json = report(1);
  for (std::size_t i = 0; i < std::size(looks); ++i) {
    EXPECT_EQ(json["frames"][i]["hints"], Json::array({looks[i].hint})) << json["frames"][i]["failures"];
  }
  EXPECT_EQ(json["sequence"]["findings"].size(), 5U);
}

TEST_F(CheckCommand, NoiseAndLostObjectsLookLikeNothingElse) {
  add_golden(0, flip_file("spheres_ref.png"));
  add_golden(10, flip_file("spheres_ref.png"));
  add_run(0, flip_file("spheres_mc16.png"));
  add_run(10, flip_file("spheres_missing.png"));
  const Json json = report(1);
  EXPECT_TRUE(json["frames"][0]["hints"].empty() && json["frames"][1]["hints"].empty());
}

TEST_F(CheckCommand, AnyVariantMayPass) {
  add_golden(0, flip_file("spheres_ref.png"));
  dir_.write("golden/variants/mac/frames/frame_0000.png", flip_file("spheres_moved.png"));
  add_run(0, flip_file("spheres_moved.png"));
  const Json json = report(0);
  EXPECT_EQ(json["frames"][0]["variant"], "mac");
  EXPECT_EQ(json["frames"][0]["decided_by"], "bytes");
  EXPECT_EQ(check({"--variant", "mac"}).status, 0);
  add_run(0, flip_file("spheres_ref.png"));
  EXPECT_EQ(check().status, 0);
  EXPECT_EQ(check({"--variant", "mac"}).status, 1);
  add_run(0, flip_file("spheres_missing.png"));
  EXPECT_EQ(report(1)["frames"][0]["variant"], nullptr);
}

TEST_F(CheckCommand, FramesThatOnlyTheRunHasMayBeIgnored) {
  add_golden(0, flip_file("one_a.png"));
  add_run(0, flip_file("one_a.png"));
  add_run(1, flip_file("one_a.png"));
  EXPECT_EQ(rules(report(1)), Json::parse(R"({"1": ["extra"]})"));
  limits("extra = \"ignore\"\n");
  const Json json = report(0);
  EXPECT_EQ(json["counts"]["frames"], 1);
  EXPECT_EQ(json["remarks"][0], "frames that only the run has are ignored by golden.toml: 1");
}

TEST_F(CheckCommand, JudgesTheBytesOnDiskAndNotTheirHashes) {
  add_golden(0, flip_file("spheres_ref.png"));
  add_run(0, flip_file("spheres_ref.png"));
  dir_.write("run/run.json", R"({"frames": [{"frame": 0, "picture_sha256": "00"}]})");
  const Json json = report(0);
  ASSERT_EQ(json["remarks"].size(), 1U);
  EXPECT_NE(
      json["remarks"][0].get<std::string>().find("tells other hashes than the pictures have, of frames 0"),
      std::string::npos);
}

TEST_F(CheckCommand, IsTheSameForAnyNumberOfThreads) {
  for (int frame = 0; frame < 8; ++frame) {
    add_golden(frame, flip_file("spheres_ref.png"));
    add_run(frame, frame % 3 == 0 ? flip_file("spheres_mc16.png") : plus(frame));
  }
  const auto once = [&](const char* threads) {
    Json json = report(1, {"--threads", threads});
    json.erase("seconds");
    for (Json& frame : json["frames"]) frame.erase("seconds");
    return std::pair(json, read_all(at("run/check/panels/frame_0003.png")));
  };
  const auto first = once("1");
  EXPECT_EQ(once("4"), first);
  EXPECT_FALSE(first.second.empty());
}

TEST_F(CheckCommand, HeatOfEarlierChecksGoes) {
  add_golden(0, flip_file("spheres_ref.png"));
  add_run(0, flip_file("spheres_moved.png"));
  EXPECT_EQ(report(1)["frames"][0]["heat"], "heat/frame_0000.png");
  EXPECT_EQ(render::read_png(read_all(at("run/check/panels/frame_0000.png")), "panel").width, 3 * 320 + 8);
  add_run(0, flip_file("spheres_ref.png"));
  EXPECT_EQ(check().status, 0);
  EXPECT_EQ(count_files(at("run/check/heat")) + count_files(at("run/check/panels")), 0);
}

TEST_F(CheckCommand, JsonAndQuiet) {
  add_golden(0, flip_file("one_a.png"));
  add_run(0, flip_file("one_b.png"));
  const Ended json = check({"--json", "-o", at("elsewhere").string()});
  EXPECT_EQ(json.status, 1);
  EXPECT_EQ(json.out, read_all(at("elsewhere/report.json")));
  EXPECT_FALSE(std::filesystem::exists(at("run/check")));
  const Json parsed = Json::parse(json.out);
  EXPECT_EQ(parsed["format"], "lagomorph-check-report");
  EXPECT_EQ(parsed["version"], 1);
  const Ended quiet = check({"--quiet"});
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(quiet.status, 1);
}

TEST_F(CheckCommand, JunitHasACaseAFrameWithOneAttachmentFirst) {
  for (int frame = 0; frame < 3; ++frame) add_golden(frame, flip_file("spheres_ref.png"));
  add_run(0, flip_file("spheres_ref.png"));
  add_run(1, flip_file("spheres_moved.png"));
  EXPECT_EQ(check({}, {.directory = dir_.path()}).status, 1);
  const std::string xml = read_all(at("run/check/junit.xml"));
  EXPECT_NE(
      xml.find("<testsuite name=\"golden\" tests=\"3\" failures=\"2\" errors=\"0\" skipped=\"0\" time=\""),
      std::string::npos)
      << xml;
  EXPECT_NE(xml.find("<testcase classname=\"check.golden\" name=\"frame 0001\" time=\"0."),
            std::string::npos);
  const std::string message =
      "flip_tile_max 0.2222 at 192,96 (16x16 pixels), limit 0.12 by preset render (the default)";
  EXPECT_NE(xml.find("<failure type=\"flip_tile_max\" message=\"" + message + "\">" + message + "\n"),
            std::string::npos)
      << xml;
  EXPECT_NE(xml.find("<system-out>[[ATTACHMENT|run/check/panels/frame_0001.png]]\n"), std::string::npos)
      << xml;
  std::size_t outs = 0, cases = 0;
  for (std::size_t i = 0; (i = xml.find("<system-out>", i)) != std::string::npos; ++i) ++outs;
  for (std::size_t i = 0; (i = xml.find("<testcase ", i)) != std::string::npos; ++i) ++cases;
  EXPECT_EQ(outs, 2U);
  EXPECT_EQ(cases, 3U);
}

TEST_F(CheckCommand, CTestMeasurementsAreTags) {
  add_golden(0, flip_file("spheres_ref.png"));
  add_run(0, flip_file("spheres_moved.png"));
  const std::string out = check({"--ctest"}).out;
  EXPECT_NE(
      out.find(
          "<CTestMeasurement type=\"numeric/double\" name=\"flip_tile_max\">0.22219</CTestMeasurement>\n"),
      std::string::npos)
      << out;
  EXPECT_NE(out.find("<CTestMeasurementFile type=\"image/png\" name=\"frame 0: golden, new, heat\">" +
                     at("run/check/panels/frame_0000.png").string() + "</CTestMeasurementFile>\n"),
            std::string::npos)
      << out;
}

TEST_F(CheckCommand, AppendsToTheJobSummary) {
  for (int frame = 0; frame < 30; ++frame) {
    add_golden(frame, flip_file("one_a.png"));
    add_run(frame, flip_file("one_b.png"));
  }
  EXPECT_NE(refusal({"--github"}).find("GITHUB_STEP_SUMMARY"), std::string::npos);
  const std::string file = dir_.write("summary.md", "before\n").string();
  const ProgramOptions options{.environment = {{"GITHUB_STEP_SUMMARY", file}}};
  const Ended ended = check({"--github"}, options);
  EXPECT_EQ(ended.status, 1) << ended.err;
  const std::string text = read_all(file);
  EXPECT_EQ(text.find("before\n## "), 0U) << text;
  EXPECT_NE(text.find("30 of 30 frames differ"), std::string::npos);
  EXPECT_EQ(text.find("data:"), std::string::npos);
  std::size_t annotations = 0;
  for (std::size_t i = 0; (i = ended.out.find("::error ", i)) != std::string::npos; ++i) ++annotations;
  EXPECT_EQ(annotations, 10U);
  EXPECT_NE(ended.out.find("(and 20 more frames)"), std::string::npos);
  dir_.write("summary.md", std::string(900 * 1024 - 500, 'x'));
  EXPECT_EQ(check({"--github"}, options).status, 1);
  EXPECT_LE(std::filesystem::file_size(file), 900U * 1024U);
}

TEST_F(CheckCommand, AFullDiskIsTheMachines) {
  add_golden(0, flip_file("spheres_ref.png"));
  add_run(0, flip_file("spheres_moved.png"));
  const Ended ended = check({}, {.largest_file = 1000});
  EXPECT_EQ(ended.status, 4) << ended.err;
}

}  // namespace check_command_test
}  // namespace lagomorph::tests
