#include "render/path/filter.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "render/error.h"

namespace lagomorph::render::path {
namespace filter_test {

const std::pair<const char*, std::function<double(double)>> filters[] = {
    {"box", [](double) { return 1.0; }},
    {"gaussian", [](double x) { return std::exp(-0.5 * (3.0 * x) * (3.0 * x)); }},
    {"blackman_harris",
     [](double x) {
       const double n = 2.0 * std::numbers::pi * (x + 1.0) / 2.0;  // the window over [0, 1]
       return 0.35875 - 0.48829 * std::cos(n) + 0.14128 * std::cos(2.0 * n) - 0.01168 * std::cos(3.0 * n);
     }},
};

TEST(Filter, OffsetsAreDistributedAsTheFilter) {
  for (const auto& [name, value] : filters) {
    for (const float radius : {0.5F, 1.5F, 4.0F}) {
      const PixelFilter filter(name, radius);
      const int n = 1 << 16;
      const int cells = 50;
      std::vector<double> count(cells, 0.0);
      for (int i = 0; i < n; ++i) {
        const double x = filter.offset((static_cast<float>(i) + 0.5F) / n) / radius;
        ASSERT_TRUE(x >= -1.0 && x <= 1.0);
        count[static_cast<std::size_t>(std::min((x + 1.0) / 2.0 * cells, cells - 1.0))] += 1.0 / n;
      }
      std::vector<double> expected(cells, 0.0);
      double total = 0.0;
      for (int i = 0; i < 1000 * cells; ++i) {
        const double v = value((i + 0.5) / (1000.0 * cells) * 2.0 - 1.0);
        expected[static_cast<std::size_t>(i / 1000)] += v;
        total += v;
      }
      for (int c = 0; c < cells; ++c) {
        const auto k = static_cast<std::size_t>(c);
        EXPECT_NEAR(count[k], expected[k] / total, 1e-3) << name << " " << radius << " cell " << c;
      }
    }
  }
}

TEST(Filter, EndsAndMiddle) {
  for (const std::string& name : filter_names()) {
    const PixelFilter filter(name, 1.5F);
    EXPECT_NEAR(filter.offset(0.0F), -1.5F, 1e-3F);
    EXPECT_NEAR(filter.offset(0.5F), 0.0F, 1e-4F);
    EXPECT_LE(filter.offset(0x1.fffffep-1F), 1.5F);
    EXPECT_NEAR(filter.offset(0.25F), -filter.offset(0.75F), 1e-4F);
  }
}

TEST(Filter, ErrorsNameTheValue) {
  try {
    PixelFilter("lanczos", 1.0F);
    FAIL();
  } catch (const SettingsError& error) {
    EXPECT_STREQ(error.what(),
                 "render.path.filter: unknown filter 'lanczos'; known are box, gaussian, blackman_harris");
  }
  for (const float radius : {0.0F, -1.0F, 4.1F, std::nanf("")}) {
    EXPECT_THROW(PixelFilter("box", radius), SettingsError) << radius;
  }
}

}  // namespace filter_test
}  // namespace lagomorph::render::path
