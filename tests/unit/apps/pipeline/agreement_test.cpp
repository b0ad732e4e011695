#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "render/png_read.h"
#include "tests/support/paths.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// The same states drawn by both back ends: what one sees where, the other sees there.
namespace lagomorph::tests {
namespace agreement_test {

namespace fs = std::filesystem;

constexpr int width = 320;
constexpr int height = 180;

/// Depth along the view axis [m], rows from the top, +inf where nothing is.
struct DepthMap {
  std::vector<float> values;

  float at(int x, int y) const { return values[static_cast<std::size_t>(y * width + x)]; }
  bool hit(int x, int y) const { return std::isfinite(at(x, y)); }

  /// Whether something within a pixel of (x, y) satisfies a condition on its depth.
  template <class Condition>
  bool near(int x, int y, const Condition& condition) const {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
        if (condition(at(i, j))) return true;
      }
    }
    return false;
  }
};

template <class Visit>
void each_pixel(const Visit& visit) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) visit(x, y);
  }
}

class Agreement : public ProgramRun {
protected:
  /// Draws frame 4 of the golden states by one back end.
  fs::path draw(const std::string& backend, const Arguments& more) const {
    const fs::path run = at(backend);
    expect(0, Arguments{"render", (lagomorph::tests::source_dir() / "tests/golden/states").string(),
                        "--frames", "4", "--backend", backend, "--set", "render.channels=[\"depth\"]",
                        "--quiet", "-o", run.string()} +
                  more);
    return run;
  }

  DepthMap depth(const std::string& backend, const Arguments& more) const {
    const std::string file = read_all(draw(backend, more) / "aov/depth/frame_0004.npy");
    EXPECT_NE(file.find("'<f4', 'fortran_order': False, 'shape': (180, 320)"), std::string::npos)
        << file.substr(0, 100);
    DepthMap map;
    map.values.resize(static_cast<std::size_t>(width * height));
    const std::size_t bytes = map.values.size() * sizeof(float);
    EXPECT_GT(file.size(), bytes);
    if (file.size() > bytes) std::memcpy(map.values.data(), file.data() + file.size() - bytes, bytes);
    return map;
  }

  void expect_same_geometry(const Arguments& more) const {
    const DepthMap raster = depth("raster", more);
    const DepthMap path = depth("path", more);
    int hits = 0, alike = 0;
    each_pixel([&](int x, int y) {
      const auto is_hit = [](float z) { return std::isfinite(z); };
      const auto is_miss = [](float z) { return std::isinf(z); };
      // Silhouettes agree to a pixel.
      EXPECT_TRUE(raster.hit(x, y) ? path.near(x, y, is_hit) : path.near(x, y, is_miss)) << x << ", " << y;
      EXPECT_TRUE(path.hit(x, y) ? raster.near(x, y, is_hit) : raster.near(x, y, is_miss)) << x << ", " << y;
      if (!raster.hit(x, y) || !path.hit(x, y)) return;
      ++hits;
      const auto same = [&](float z) { return std::abs(z - raster.at(x, y)) <= 1e-4F * raster.at(x, y); };
      if (same(path.at(x, y))) {
        ++alike;
      } else {  // where one surface ends before another, the edge may fall a pixel further
        EXPECT_TRUE(path.near(x, y, same))
            << x << ", " << y << ": " << raster.at(x, y) << " and " << path.at(x, y);
      }
    });
    EXPECT_GT(hits, 3000);
    EXPECT_GE(alike, hits - hits / 1000) << alike << " of " << hits;
  }
};

const Arguments quick = {"--set", "render.samples=1"};

TEST_F(Agreement, OfDepthAndSilhouettes) {
  expect_same_geometry(quick + Arguments{"--set", "ground.enabled=false"});
}

TEST_F(Agreement, OfDepthWithTheGround) { expect_same_geometry(quick); }

TEST_F(Agreement, OfOrthographicViews) {
  expect_same_geometry(quick +
                       Arguments{"--set", "camera.orthographic=2.0", "--set", "ground.enabled=false"});
}

TEST_F(Agreement, OfLight) {
  const Arguments samples = {"--set", "render.samples=64"};
  const auto picture = [&](const std::string& backend) {
    const std::string file = (draw(backend, samples) / "frames/frame_0004.png").string();
    return std::get<0>(render::read_png(read_all(file), file).samples);
  };
  const auto raster = picture("raster"), path = picture("path");
  ASSERT_EQ(raster.size(), path.size());
  double sum = 0.0, bias = 0.0;
  for (std::size_t i = 0; i < raster.size(); ++i) {
    const double difference = (static_cast<double>(raster[i]) - static_cast<double>(path[i])) / 255.0;
    sum += std::abs(difference);
    bias += difference;
  }
  const auto count = static_cast<double>(raster.size());
  EXPECT_LT(sum / count, 0.005);
  EXPECT_LT(std::abs(bias) / count, 0.002);
  RecordProperty("mean_difference", std::to_string(sum / count));
  RecordProperty("bias", std::to_string(bias / count));
}

}  // namespace agreement_test
}  // namespace lagomorph::tests
