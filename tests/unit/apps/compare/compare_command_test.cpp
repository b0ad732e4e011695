#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "render/png_read.h"
#include "tests/support/png_maker.h"
#include "tests/support/program.h"
#include "tests/support/run_tree.h"

/// `lagomorph compare` as scripts see it.
namespace lagomorph::tests {
namespace compare_command_test {

using Json = nlohmann::ordered_json;

std::string picture(const std::string& name) { return data_file("flip/png/" + name).string(); }

/// What `--json` prints; expects the status.
Json compare(int status, const std::string& a, const std::string& b,
             const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"compare", a, b, "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ended ended = run_program(arguments);
  EXPECT_EQ(ended.status, status) << ended.err;
  EXPECT_EQ(ended.err, "");
  return Json::parse(ended.out);
}

/// One line on stderr, nothing on stdout, status 2.
std::string refusal(const std::vector<std::string>& arguments) {
  const Ended ended = run_program(arguments);
  EXPECT_EQ(ended.status, 2) << ended.err;
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_EQ(ended.err.find("lagomorph: error: "), 0U) << ended.err;
  return ended.err;
}

/// Rows of the reference by the columns' names.
std::vector<std::map<std::string, std::string>> reference() {
  std::ifstream in(data_file("flip/flip_reference.csv"));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> result;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) result.push_back(cell);
    return result;
  };
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = cells(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> values = cells(line);
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < values.size(); ++i) row[names[i]] = values[i];
  }
  return rows;
}

TEST(CompareCommand, PrintsTheFiguresOfTheReference) {
  const auto rows = reference();
  ASSERT_EQ(rows.size(), 11U);
  for (const auto& row : rows) {
    SCOPED_TRACE(row.at("case"));
    // FLIP sees no checker of single pixels; what it does see of it is small.
    const std::string& name = row.at("case");
    const bool passes = name == "spheres_mc256" || name == "edge_aa" || name == "checker_grey188";
    const Json json = compare(passes ? 0 : 1, picture(row.at("reference")), picture(row.at("test")));
    const auto expect = [&](const char* key, const char* column, double tolerance) {
      EXPECT_NEAR(json.at(key).get<double>(), std::stod(row.at(column)), tolerance) << key;
    };
    expect("flip_mean", "flip_mean_f64pool", 2e-5);
    expect("flip_q1", "flip_wq1_f64pool", 2e-4);
    expect("flip_median", "flip_wmedian_f64pool", 2e-4);
    expect("flip_q3", "flip_wq3_f64pool", 2e-4);
    expect("flip_max", "flip_max_f32", 2e-4);
    expect("psnr", "psnr_rgb_db", 1e-3);
    expect("rmse", "rms_err", 1e-6);
    expect("max_abs", "max_abs_err", 1e-6);
    if (row.at("ssim_skimage_rgb") == "nan") {
      EXPECT_TRUE(json.at("ssim").is_null());
    } else {
      expect("ssim", "ssim_skimage_rgb", 1e-5);
    }
    EXPECT_EQ(json.at("same").get<bool>(), passes);
    EXPECT_FALSE(json.at("equal").get<bool>());
  }
}

TEST(CompareCommand, JsonHasTheKeysOfTheContractInOrder) {
  const Json json = compare(0, picture("spheres_ref.png"), picture("spheres_ref.png"));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys,
            (std::vector<std::string>{"same", "flip_mean", "flip_q1", "flip_median", "flip_q3", "flip_max",
                                      "flip_tile_max", "psnr", "ssim", "rmse", "max_abs", "equal"}));
  EXPECT_TRUE(json.at("same").get<bool>() && json.at("equal").get<bool>());
  EXPECT_TRUE(json.at("psnr").is_null());
  EXPECT_EQ(json.at("ssim").get<double>(), 1);
  for (const char* zero :
       {"flip_mean", "flip_q1", "flip_median", "flip_q3", "flip_max", "flip_tile_max", "rmse", "max_abs"}) {
    EXPECT_EQ(json.at(zero).get<double>(), 0) << zero;
  }
}

TEST(CompareCommand, TellsPeopleTheRuleThatIsBroken) {
  const Ended ended = run_program({"compare", picture("spheres_ref.png"), picture("spheres_moved.png")});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.out.find(
                "different\n  fails by      flip_tile_max 0.2222 at 192,96 (16x16 pixels), limit 0.12\n"),
            std::string::npos)
      << ended.out;
}

TEST(CompareCommand, PixelsPerDegreeChangeTheFigures) {
  const auto mean = [](int status, const std::vector<std::string>& more) {
    return compare(status, picture("spheres_ref.png"), picture("spheres_mc256.png"), more)
        .at("flip_mean")
        .get<double>();
  };
  EXPECT_NEAR(mean(0, {}), mean(0, {"--ppd", "67.0206432765822"}),
              1e-12);  // 3840 pi / 180, not 67.0206 itself
  EXPECT_GT(mean(1, {"--ppd", "20"}),
            2 * mean(0, {}));  // nearer is fewer pixels a degree, and noise is seen better
}

TEST(CompareCommand, WritesHeat) {
  const TemporaryDirectory dir;
  const std::string file = (dir.path() / "deep" / "heat.png").string();
  compare(1, picture("spheres_ref.png"), picture("spheres_moved.png"), {"--heat", file, "-o", dir.path()});
  const std::string bytes = read_all(file);
  EXPECT_EQ(read_all(dir.path() / "heat.png"), bytes);
  const render::Pixels heat = render::read_png(bytes, file);
  ASSERT_EQ(heat.width, 320);
  ASSERT_EQ(heat.height, 180);
  const auto brightness = [&](int x, int y) {
    const auto& samples = std::get<0>(heat.samples);
    const auto at = static_cast<std::size_t>(3 * (y * heat.width + x));
    return samples[at] + samples[at + 1] + samples[at + 2];
  };
  EXPECT_LT(brightness(5, 5), 10);  // equal there
  int brightest = 0;
  for (int y = 96; y < 112; ++y) {
    for (int x = 192; x < 208; ++x) brightest = std::max(brightest, brightness(x, y));
  }
  EXPECT_GT(brightest, 300);
  compare(0, picture("edge_ref.png"), picture("edge_ref.png"), {"--heat", file});
  EXPECT_EQ(render::read_png(read_all(file), file).width, 101);
}

TEST(CompareCommand, OtherSizesAreDifferentByName) {
  const Json json = compare(1, picture("edge_ref.png"), picture("black.png"));
  EXPECT_FALSE(json.at("same").get<bool>() || json.at("equal").get<bool>());
  EXPECT_TRUE(json.at("flip_mean").is_null() && json.at("rmse").is_null());
  const Ended ended = run_program({"compare", picture("edge_ref.png"), picture("black.png")});
  EXPECT_NE(ended.out.find("fails by      size 101x67 against 64x48\n"), std::string::npos) << ended.out;
}

class OddPictures : public testing::Test {
protected:
  std::string write(const std::string& name, const std::string& bytes) const {
    return dir_.write(name, bytes).string();
  }
  /// 40x30 of a kind, the same grey or colours in all of them.
  std::string make(const std::string& name, PngSpec spec) const {
    spec.width = 40, spec.height = 30;
    const unsigned full = (1U << static_cast<unsigned>(spec.depth)) - 1U;
    for (unsigned i = 0; i < 40 * 30; ++i) {
      for (int c = 0; c < spec.stored_channels(); ++c) {
        const bool alpha = c == spec.stored_channels() - 1 && (spec.color_type & 4) != 0;
        const unsigned level = i * 13 / 7 % 4;  // 0, 85, 170 and 255 of 255
        spec.samples.push_back(spec.color_type == 3 ? level : alpha ? full : level * (full / 3));
      }
    }
    return write(name, make_png(spec));
  }
  TemporaryDirectory dir_;
};

TEST_F(OddPictures, OfOneColourAreEqualWhateverTheirKind) {
  const std::string rgb = make("rgb.png", {});
  const std::string interlaced = make("interlaced.png", {.interlaced = true});
  const std::string palette =
      make("palette.png",
           {.depth = 2, .color_type = 3, .palette = std::string("\0\0\0UUU\xAA\xAA\xAA\xFF\xFF\xFF", 12)});
  EXPECT_TRUE(compare(0, rgb, interlaced).at("equal").get<bool>());
  EXPECT_TRUE(compare(0, rgb, palette).at("equal").get<bool>());
  // The colours are equal, the kinds are not: nothing is converted in silence.
  const struct {
    std::string file, rule;
  } others[] = {{make("grey.png", {.color_type = 0}), "channels RGB against grey"},
                {make("grey2.png", {.depth = 2, .color_type = 0}), "channels RGB against grey"},
                {make("deep.png", {.depth = 16}), "bit_depth 8 against 16"},
                {make("alpha.png", {.color_type = 6}), "channels RGB against RGB and alpha"}};
  for (const auto& other : others) {
    const Json json = compare(1, rgb, other.file);
    EXPECT_TRUE(json.at("equal").get<bool>()) << other.file;
    EXPECT_FALSE(json.at("same").get<bool>()) << other.file;
    EXPECT_NE(run_program({"compare", rgb, other.file}).out.find("fails by      " + other.rule + "\n"),
              std::string::npos)
        << other.rule;
    EXPECT_TRUE(compare(0, other.file, other.file).at("same").get<bool>()) << other.file;
  }
}

TEST_F(OddPictures, AlphaIsCompared) {
  const std::string opaque = write("a.png", make_png({.color_type = 6, .samples = {10, 20, 30, 255}}));
  const std::string clear = write("b.png", make_png({.color_type = 6, .samples = {10, 20, 30, 0}}));
  const Json json = compare(1, opaque, clear);
  EXPECT_TRUE(json.at("equal").get<bool>());
  EXPECT_NE(
      run_program({"compare", opaque, clear}).out.find("alpha_tile_max 1 at 0,0 (1x1 pixels), limit 0.12"),
      std::string::npos);
}

TEST_F(OddPictures, OnePixel) {
  EXPECT_TRUE(compare(0, picture("one_a.png"), picture("one_a.png")).at("ssim").is_null());
  EXPECT_FALSE(compare(1, picture("one_a.png"), picture("one_b.png")).at("same").get<bool>());
}

TEST_F(OddPictures, WhatIsNoWholePictureIsRefusedInOneLine) {
  const std::string good = picture("edge_ref.png");
  const std::string bytes = read_all(good);
  const struct {
    std::string file, message;
  } cases[] = {
      {write("truncated.png", bytes.substr(0, bytes.size() / 2)), "is truncated"},
      {write("cut.png", bytes.substr(0, bytes.size() - 1)), "is truncated"},
      {write("empty.png", ""), "is empty"},
      {write("text.png", "not a picture\n"), "is no PNG"},
      {write("huge.png", png_signature + png_header({.width = 2000000000, .height = 2000000000}) +
                             png_chunk("IDAT", "x") + png_chunk("IEND", "")),
       "its header claims 2000000000x2000000000"},
      {write("bomb.png", png_signature + png_header({.width = 16000, .height = 16000}) +
                             png_chunk("IDAT", zlib_stored("x")) + png_chunk("IEND", "")),
       "its header claims 16000x16000 pixels, more than its 12 bytes"},
      {write("zero.png", png_signature + png_header({.width = 0, .height = 5}) + png_chunk("IEND", "")),
       "its header claims 0x5"},
      {(dir_.path() / "none.png").string(), "cannot be read"},
      {dir_.path().string(), "is a folder"},
  };
  for (const auto& c : cases) {
    EXPECT_NE(refusal({"compare", good, c.file}).find(c.file + ": " + c.message), std::string::npos)
        << c.file << ": " << refusal({"compare", good, c.file});
    refusal({"compare", c.file, good});
    refusal({"compare", c.file, c.file, "--json"});
  }
}

TEST_F(OddPictures, NothingIsWrittenOfARefusal) {
  const std::string heat = (dir_.path() / "heat.png").string();
  refusal({"compare", picture("one_a.png"), write("text.png", "no"), "--heat", heat});
  EXPECT_FALSE(std::filesystem::exists(heat));
}

}  // namespace compare_command_test
}  // namespace lagomorph::tests
