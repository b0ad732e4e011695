#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/image_compare/compare.h"
#include "tests/support/pictures.h"

/// Every pair of tests/data/flip against its reference figures, within the tolerances of the README there.
namespace lagomorph::render {
namespace reference_test {

struct Case : std::map<std::string, std::string> {};
void PrintTo(const Case& c, std::ostream* out) { *out << c.at("case"); }

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) result.push_back(cell);
  return result;
}

std::vector<Case> cases() {
  std::istringstream in(tests::file_bytes(tests::flip_path("flip_reference.csv")));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = cells(line);
  std::vector<Case> result;
  while (std::getline(in, line)) {
    const std::vector<std::string> row = cells(line);
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == 0) result.emplace_back();
      result.back()[names.at(i)] = row[i];
    }
  }
  return result;
}

class Reference : public ::testing::TestWithParam<Case> {
protected:
  double expected(const std::string& column) const { return std::stod(GetParam().at(column)); }
  Pixels picture(const std::string& column) const { return tests::flip_picture(GetParam().at(column)); }
};

TEST_P(Reference, Flip) {
  const Figures figures = compare_pictures(picture("reference"), picture("test"), expected("ppd")).figures;
  EXPECT_FALSE(figures.equal);
  EXPECT_NEAR(figures.flip_mean, expected("flip_mean_f64pool"), 2e-5);
  EXPECT_NEAR(figures.flip_quartiles[0], expected("flip_wq1_f64pool"), 2e-4);
  EXPECT_NEAR(figures.flip_quartiles[1], expected("flip_wmedian_f64pool"), 2e-4);
  EXPECT_NEAR(figures.flip_quartiles[2], expected("flip_wq3_f64pool"), 2e-4);
  EXPECT_NEAR(figures.flip_max, expected("flip_max_f32"), 2e-4);
  EXPECT_NEAR(figures.flip_min, expected("flip_min_cli"), 2e-4);
}

TEST_P(Reference, FlipOfTheIndependentImplementation) {
  const Figures figures = compare_pictures(picture("reference"), picture("test"), expected("ppd")).figures;
  EXPECT_NEAR(figures.flip_mean, expected("indep_np_mean"), 1e-5);
  EXPECT_NEAR(figures.flip_max, expected("indep_np_max"), 1e-5);
}

TEST_P(Reference, PlainDifferences) {
  const Differences d = compare_pictures(picture("reference"), picture("test")).figures.differences;
  EXPECT_NEAR(d.psnr().value(), expected("psnr_rgb_db"), 1e-3);
  EXPECT_NEAR(d.mean_absolute(), expected("mean_abs_err"), 1e-8);
  EXPECT_NEAR(d.root_mean_square(), expected("rms_err"), 1e-8);
  EXPECT_NEAR(d.largest(), expected("max_abs_err"), 1e-6);
  EXPECT_EQ(static_cast<double>(d.pixels), expected("px_diff"));
}

TEST_P(Reference, StructuralSimilarity) {
  const auto similarity = compare_pictures(picture("reference"), picture("test")).figures.ssim;
  if (GetParam().at("ssim_skimage_rgb") == "nan") {
    EXPECT_FALSE(similarity.has_value());
  } else {
    EXPECT_NEAR(similarity.value(), expected("ssim_skimage_rgb"), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, Reference, ::testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.at("case"); });

}  // namespace reference_test
}  // namespace lagomorph::render
