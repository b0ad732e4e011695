#include "render/colormap.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "render/color.h"
#include "render/error.h"

namespace lagomorph::render {
namespace colormap_test {

using Rgb = std::array<float, 3>;

constexpr float rounding = 0.5F / 255.0F + 1e-6F;  // of the tables

void expect_near(const Rgb& a, const Rgb& b, float tolerance, const std::string& what) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << what << " " << c;
}

/// Entries 0, 128 and 255 of matplotlib 3.6.3.
TEST(Colormap, IsThePublishedOne) {
  const struct {
    const char* name;
    Rgb first, middle, last;
  } maps[] = {
      {"viridis",
       {0.267004F, 0.004874F, 0.329415F},
       {0.127568F, 0.566949F, 0.550556F},
       {0.993248F, 0.906157F, 0.143936F}},
      {"magma",
       {0.001462F, 0.000466F, 0.013866F},
       {0.716387F, 0.214982F, 0.475290F},
       {0.987053F, 0.991438F, 0.749504F}},
      {"plasma",
       {0.050383F, 0.029803F, 0.527975F},
       {0.798216F, 0.280197F, 0.469538F},
       {0.940015F, 0.975158F, 0.131326F}},
      {"inferno",
       {0.001462F, 0.000466F, 0.013866F},
       {0.735683F, 0.215906F, 0.330245F},
       {0.988362F, 0.998364F, 0.644924F}},
      {"cividis",
       {0.0F, 0.135112F, 0.304751F},
       {0.488697F, 0.485318F, 0.471008F},
       {0.995737F, 0.909344F, 0.217772F}},
      {"coolwarm",
       {0.229806F, 0.298718F, 0.753683F},
       {0.867428F, 0.864377F, 0.862602F},
       {0.705673F, 0.015556F, 0.150233F}},
  };
  for (const auto& map : maps) {
    const Colormap& found = find_colormap(map.name);
    expect_near(srgb_of(found, 0.0F), map.first, rounding, map.name);
    expect_near(srgb_of(found, 128.0F / 255.0F), map.middle, rounding, map.name);
    expect_near(srgb_of(found, 1.0F), map.last, rounding, map.name);
  }
}

TEST(Colormap, TheMiddleOfADivergingOneIsGrey) {
  const Colormap& map = find_colormap("coolwarm");
  EXPECT_TRUE(map.diverging);
  expect_near(srgb_of(map, 0.5F), {0.8654F, 0.8654F, 0.8654F}, 2.0F * rounding, "coolwarm");
  EXPECT_FALSE(find_colormap("viridis").diverging);
}

TEST(Colormap, IsLinearBetweenItsSteps) {
  for (const std::string& name : colormap_names()) {
    const Colormap& map = find_colormap(name);
    const Rgb a = srgb_of(map, 100.0F / 255.0F), b = srgb_of(map, 101.0F / 255.0F);
    expect_near(srgb_of(map, 100.25F / 255.0F),
                {0.75F * a[0] + 0.25F * b[0], 0.75F * a[1] + 0.25F * b[1], 0.75F * a[2] + 0.25F * b[2]},
                1e-5F, name);
  }
  expect_near(srgb_of(find_colormap("gray"), 0.3F), {0.3F, 0.3F, 0.3F}, 0.0F, "gray");
}

TEST(Colormap, SequentialOnesGetBrighter) {
  for (const char* name : {"viridis", "magma", "plasma", "inferno", "cividis", "gray"}) {
    const Colormap& map = find_colormap(name);
    const auto luminance = [&](int i) {
      const Color c = color_of(map, static_cast<float>(i) / 64.0F);
      return 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2];
    };
    for (int i = 1; i <= 64; ++i) EXPECT_GT(luminance(i), luminance(i - 1)) << name << " " << i;
  }
}

TEST(Colormap, GivesLinearLight) {
  const Colormap& map = find_colormap("plasma");
  const Rgb srgb = srgb_of(map, 0.37F);
  const Color linear = color_of(map, 0.37F);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_EQ(linear[static_cast<Eigen::Index>(c)], linear_from_srgb(srgb[c]));
}

TEST(Colormap, ClampsAndTellsUnknownNames) {
  const Colormap& map = find_colormap("viridis");
  EXPECT_EQ(srgb_of(map, -3.0F), srgb_of(map, 0.0F));
  EXPECT_EQ(srgb_of(map, INFINITY), srgb_of(map, 1.0F));
  EXPECT_EQ(srgb_of(map, std::nanf("")), srgb_of(map, 0.0F));
  try {
    find_colormap("jet");
    ADD_FAILURE();
  } catch (const SettingsError& error) {
    EXPECT_STREQ(
        error.what(),
        "unknown colormap 'jet'; known are viridis, magma, plasma, inferno, cividis, coolwarm, gray");
  }
}

}  // namespace colormap_test
}  // namespace lagomorph::render
