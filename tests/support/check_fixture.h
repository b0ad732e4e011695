#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "render/png.h"
#include "render/png_read.h"
#include "tests/support/program.h"
#include "tests/support/run_tree.h"
#include "tests/support/temporary_directory.h"

/// Runs and goldens made of the pictures of tests/data/flip, checked by the program itself.
namespace lagomorph::tests {

inline std::string flip_file(const std::string& name) { return read_all(data_file("flip/png/" + name)); }

/// A PNG file with every sample changed. `change(value, index)` of [0, 255].
template <class Change>
std::string changed(const std::string& png, const Change& change) {
  render::Pixels pixels = render::read_png(png, "a test's picture");
  auto& samples = std::get<0>(pixels.samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = static_cast<std::uint8_t>(std::clamp(std::lround(change(1.0 * samples[i], i)), 0L, 255L));
  }
  return render::encode_png({pixels.width, pixels.height, samples}, 1);
}

/// A picture of tests/data/flip likewise.
template <class Change>
std::string changed_png(const std::string& name, const Change& change) {
  return changed(flip_file(name), change);
}

/// One moved to the right and down; the border repeats.
inline std::string shifted_png(const std::string& name, int dx, int dy) {
  const render::Pixels pixels = render::read_png(flip_file(name), name);
  const auto& from = std::get<0>(pixels.samples);
  render::Picture picture{pixels.width, pixels.height, from};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int u = std::clamp(x - dx, 0, picture.width - 1), v = std::clamp(y - dy, 0, picture.height - 1);
      std::copy_n(from.begin() + std::ptrdiff_t{3} * (v * picture.width + u), 3,
                  picture.rgb.begin() + std::ptrdiff_t{3} * (y * picture.width + x));
    }
  }
  return render::encode_png(picture, 1);
}

class CheckFixture : public testing::Test {
protected:
  std::filesystem::path at(const std::string& name) const { return dir_.path() / name; }
  static std::string frame_name(int frame) {
    std::string digits = std::to_string(frame);
    digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
    return "frame_" + digits + ".png";
  }
  void add_golden(int frame, const std::string& png) const {
    dir_.write("golden/frames/" + frame_name(frame), png);
  }
  void add_run(int frame, const std::string& png) const {
    dir_.write("run/frames/" + frame_name(frame), png);
  }
  /// golden.toml, three lines of it being of the caller.
  void limits(const std::string& toml) const { dir_.write("golden/golden.toml", toml); }

  Ended check(const std::vector<std::string>& more = {}, const ProgramOptions& options = {}) const {
    std::vector<std::string> arguments = {"check", at("run").string(), at("golden").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, options);
  }
  /// The report, after a check that ends with the status.
  nlohmann::json report(int status, const std::vector<std::string>& more = {}) const {
    const Ended ended = check(more);
    EXPECT_EQ(ended.status, status) << ended.err << ended.out;
    return nlohmann::json::parse(read_all(at("run/check/report.json")));
  }
  /// The rules that each frame breaks: {"0": [...]}, failing frames only.
  static nlohmann::json rules(const nlohmann::json& report) {
    nlohmann::json all = nlohmann::json::object();
    for (const auto& frame : report.at("frames")) {
      for (const auto& failure : frame.at("failures"))
        all[std::to_string(frame.at("frame").get<int>())].push_back(failure.at("rule"));
    }
    return all;
  }
  /// One line on stderr, nothing on stdout, status 2, nothing written.
  std::string refusal(const std::vector<std::string>& more = {}) const {
    const Ended ended = check(more);
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(at("run/check")));
    return ended.err;
  }

  TemporaryDirectory dir_;
};

}  // namespace lagomorph::tests
