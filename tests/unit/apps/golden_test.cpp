#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <toml++/toml.h>

#include "render/png_read.h"
#include "tests/support/program.h"
#include "tests/support/temporary_directory.h"

/// Pictures of committed states (tests/golden/states) against committed pictures (tests/golden/<case>), so
/// that physics cannot move them. The limits of each case stand in its golden.toml.
namespace lagomorph::tests {
namespace {

namespace fs = std::filesystem;

const fs::path golden = fs::path(LAGOMORPH_SOURCE_DIR) / "tests/golden";

render::Pixels read_picture(const fs::path& file) { return render::read_png(read_all(file), file.string()); }

struct Difference {
  double mean = 0.0;       // absolute, of values scaled to [0, 1]
  double tile_mean = 0.0;  // the largest over tiles of 16x16 pixels
};

Difference difference(const render::Pixels& a, const render::Pixels& b) {
  constexpr int tile = 16;
  const auto& x = std::get<0>(a.samples);
  const auto& y = std::get<0>(b.samples);
  Difference d;
  for (int ty = 0; ty < a.height; ty += tile) {
    for (int tx = 0; tx < a.width; tx += tile) {
      const int right = std::min(tx + tile, a.width), bottom = std::min(ty + tile, a.height);
      double sum = 0.0;
      for (int row = ty; row < bottom; ++row) {
        for (int i = 3 * tx; i < 3 * right; ++i) {
          const std::size_t at = static_cast<std::size_t>(3 * row) * static_cast<std::size_t>(a.width) +
                                 static_cast<std::size_t>(i);
          sum += std::abs(x[at] - y[at]) / 255.0;
        }
      }
      d.mean += sum;
      d.tile_mean = std::max(d.tile_mean, sum / (3.0 * (right - tx) * (bottom - ty)));
    }
  }
  d.mean /= 3.0 * a.width * a.height;
  return d;
}

class Golden : public testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    const toml::table limits = toml::parse_file((golden / GetParam() / "golden.toml").string());
    mean_ = limits["limits"]["mean"].value<double>().value();
    tile_mean_ = limits["limits"]["tile_mean"].value<double>().value();
    backend_ = limits["backend"].value<std::string>().value();
    for (const auto& file : fs::directory_iterator(golden / GetParam() / "frames"))
      frames_.push_back(file.path());
    std::sort(frames_.begin(), frames_.end());
    ASSERT_FALSE(frames_.empty());
  }
  /// Draws one frame of the committed states.
  fs::path draw(const TemporaryDirectory& directory, const fs::path& frame) const {
    const std::string number = std::to_string(std::stoi(frame.stem().string().substr(6)));
    const fs::path run = directory.path() / "run";
    const Ended ended = run_program({"render", (golden / "states").string(), "--backend", backend_,
                                     "--frames", number, "--out", run.string(), "--quiet"},
                                    directory);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return run / "frames" / frame.filename();
  }
  double mean_ = 0.0, tile_mean_ = 0.0;
  std::string backend_;
  std::vector<fs::path> frames_;
};

TEST_P(Golden, PicturesOfCommittedStatesAreTheCommittedOnes) {
  const TemporaryDirectory directory;
  for (const fs::path& frame : frames_) {
    const render::Pixels expected = read_picture(frame), found = read_picture(draw(directory, frame));
    ASSERT_EQ(found.width, expected.width);
    ASSERT_EQ(found.height, expected.height);
    const Difference d = difference(expected, found);
    EXPECT_LE(d.mean, mean_) << frame;
    EXPECT_LE(d.tile_mean, tile_mean_) << frame;
  }
}

// A golden that every picture passes is none: neighbouring frames and the other back end's picture are
// refused.
TEST_P(Golden, AnotherFrameFails) {
  ASSERT_GE(frames_.size(), 2U);
  const Difference d = difference(read_picture(frames_[0]), read_picture(frames_[1]));
  EXPECT_GT(d.tile_mean, 4.0 * tile_mean_);
}

INSTANTIATE_TEST_SUITE_P(Cases, Golden, testing::Values("bunny_raster", "bunny_path"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace lagomorph::tests
