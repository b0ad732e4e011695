#include "render/color.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "render/error.h"

namespace lagomorph::render {
namespace color_test {

Image image_of(const std::vector<Color>& pixels) {
  Image image(static_cast<int>(pixels.size()), 1);
  std::vector<float>& values = image.add("color", 3);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) values[3 * i + k] = pixels[i][static_cast<int>(k)];
  }
  return image;
}

int exact_code(double linear) {
  const double x = std::min(std::max(linear, 0.0), 1.0);
  const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<int>(std::floor(255.0 * s + 0.5));
}

using Rgb = Eigen::Array3d;

Rgb reinhard(const Rgb& c) {
  const double luminance = (c * Rgb(0.2126, 0.7152, 0.0722)).sum();
  return c / (1.0 + luminance);
}

Rgb aces(const Rgb& c) {
  Eigen::Matrix3d in, out;
  in << 0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840, 0.13383, 0.83777;
  out << 1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602;
  const Rgb v = (in * c.matrix()).array();
  const Rgb fit = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
  return (out * fit.matrix()).array();
}

/// As the specification writes it: c_out by f, p, p_n and g.
Rgb pbr_neutral(const Rgb& c) {
  const double f90 = 0.04, ks = 0.8 - f90, kd = 0.15;
  const double x = c.minCoeff();
  const double f = x <= 2.0 * f90 ? x - x * x / (4.0 * f90) : f90;
  const double p = (c - f).maxCoeff();
  if (p <= ks) return c - f;
  const double pn = 1.0 - (1.0 - ks) * (1.0 - ks) / (p + 1.0 - 2.0 * ks);
  const double g = 1.0 / (kd * (p - pn) + 1.0);
  return (c - f) * (pn / p) * g + pn * (1.0 - g);
}

TEST(Color, SrgbMeetsTheStandardAndItsInverse) {
  EXPECT_FLOAT_EQ(srgb_from_linear(0.0F), 0.0F);
  EXPECT_FLOAT_EQ(srgb_from_linear(1.0F), 1.0F);
  EXPECT_FLOAT_EQ(srgb_from_linear(0.001F), 0.01292F);
  EXPECT_NEAR(srgb_from_linear(0.5F), 0.735357F, 1e-6F);
  EXPECT_NEAR(linear_from_srgb(0.5F), 0.214041F, 1e-6F);
  EXPECT_FLOAT_EQ(srgb_from_linear(-1.0F), 0.0F);
  EXPECT_FLOAT_EQ(srgb_from_linear(7.0F), 1.0F);
  EXPECT_FLOAT_EQ(linear_from_srgb(-1.0F), 0.0F);
  EXPECT_FLOAT_EQ(linear_from_srgb(7.0F), 1.0F);
  for (int i = 0; i <= 1000; ++i) {
    const float s = static_cast<float>(i) / 1000.0F;
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(s)), s, 2e-7F);
  }
}

TEST(Color, EightBitValuesEqualTheExactCurve) {
  std::vector<Color> pixels;
  std::vector<float> values;
  const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0F);
  for (std::uint32_t bits = std::bit_cast<std::uint32_t>(1e-5F); bits < one; bits += 97) {
    values.push_back(std::bit_cast<float>(bits));
  }
  // The floats on both sides of every place where the code changes.
  for (int code = 1; code <= 255; ++code) {
    std::uint32_t low = 0, high = one;
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (exact_code(std::bit_cast<float>(middle)) >= code ? high : low) = middle;
    }
    values.push_back(std::bit_cast<float>(low));
    values.push_back(std::bit_cast<float>(high));
  }
  for (const float v : values) pixels.emplace_back(v, v, v);
  const Picture picture = tone_map(image_of(pixels), "none", 0.0F);
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(picture.rgb[3 * i], exact_code(values[i])) << values[i];
}

TEST(Color, CurvesMeetTheirFormulas) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> stops(-12.0F, 6.0F);
  std::vector<Color> pixels;
  for (int i = 0; i < 20000; ++i) {
    pixels.emplace_back(std::exp2(stops(random)), std::exp2(stops(random)), std::exp2(stops(random)));
  }
  const float exposure = 0.7F;
  const std::pair<const char*, Rgb (*)(const Rgb&)> curves[] = {
      {"reinhard", reinhard}, {"aces", aces}, {"pbr_neutral", pbr_neutral}};
  for (const auto& [name, curve] : curves) {
    const Picture picture = tone_map(image_of(pixels), name, exposure);
    int differ = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Rgb out = curve(pixels[i].cast<double>() * std::exp2(static_cast<double>(exposure)));
      for (std::size_t k = 0; k < 3; ++k) {
        const int code = picture.rgb[3 * i + k];
        const int expected = exact_code(out[static_cast<int>(k)]);
        ASSERT_NEAR(code, expected, 1) << name << " " << pixels[i].transpose();
        differ += code != expected ? 1 : 0;
      }
    }
    EXPECT_LT(differ, 30) << name;  // of 60000: float's rounding next to a code's edge
  }
}

TEST(Color, NeutralKeepsBaseColoursAndCompressesWhite) {
  // Under the shoulder a colour is only shifted by 0.04; white light of 1 shows under white.
  const Picture picture =
      tone_map(image_of({Color(0.5F, 0.3F, 0.2F), Color(1.0F, 1.0F, 1.0F), Color(50.0F, 0.0F, 0.0F)}),
               "pbr_neutral", 0.0F);
  EXPECT_EQ(picture.rgb[0], exact_code(0.46));
  EXPECT_EQ(picture.rgb[1], exact_code(0.26));
  EXPECT_EQ(picture.rgb[2], exact_code(0.16));
  EXPECT_GT(picture.rgb[3], 220);
  EXPECT_LT(picture.rgb[3], 255);
  EXPECT_GT(picture.rgb[7], 150);  // a very bright red goes towards white
}

TEST(Color, OddValuesHaveAPlace) {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::string& curve : tone_curve_names()) {
    const Picture picture = tone_map(
        image_of({Color(nan, 1.0F, 1.0F), Color(-1.0F, -2.0F, -inf), Color(inf, inf, inf)}), curve, 0.0F);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(picture.rgb[i], 0) << curve;
    for (std::size_t i = 6; i < 9; ++i) EXPECT_EQ(picture.rgb[i], 255) << curve;
  }
}

TEST(Color, ExposureDoublesLightAStop) {
  const Picture bright = tone_map(image_of({Color(0.1F, 0.2F, 0.05F)}), "none", 2.0F);
  const Picture plain = tone_map(image_of({Color(0.4F, 0.8F, 0.2F)}), "none", 0.0F);
  EXPECT_EQ(bright.rgb, plain.rgb);
}

TEST(Color, AnyNumberOfThreadsGivesTheSameBytes) {
  std::vector<Color> pixels;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(0.0F, 2.0F);
  for (int i = 0; i < 200000; ++i) pixels.emplace_back(uniform(random), uniform(random), uniform(random));
  const Image image = image_of(pixels);
  std::vector<std::uint8_t> one;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    one = tone_map(image, "aces", 0.0F).rgb;
  }
  EXPECT_EQ(tone_map(image, "aces", 0.0F).rgb, one);
}

/// A picture of one grey.
Image plain_image(int side, float grey) {
  Image image(side, side);
  std::vector<float>& values = image.add("color", 3);
  std::fill(values.begin(), values.end(), grey);
  return image;
}

double mean_code(const Picture& picture) {
  double sum = 0.0;
  for (const std::uint8_t code : picture.rgb) sum += code;
  return sum / static_cast<double>(picture.rgb.size());
}

/// What rounding loses, the pattern keeps in the mean of any 16 x 16 pixels.
TEST(Color, DitheredPicturesHaveTheLightInTheMean) {
  for (const double code : {0.3, 1.0, 17.25, 100.5, 187.9, 254.7}) {
    const float grey = linear_from_srgb(static_cast<float>(code / 255.0));
    const Picture picture = tone_map(plain_image(16, grey), "none", 0.0F, false, 1.0F);
    EXPECT_NEAR(mean_code(picture), code, 0.03) << code;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
      ASSERT_GE(picture.rgb[i], static_cast<int>(std::floor(code - 1e-4))) << code;
      ASSERT_LE(picture.rgb[i], static_cast<int>(std::ceil(code + 1e-4))) << code;
      ASSERT_TRUE(picture.rgb[i] == picture.rgb[i + 1] && picture.rgb[i] == picture.rgb[i + 2]) << "grey";
    }
  }
}

TEST(Color, DitheringIsAsStrongAsItIsToldToBe) {
  const auto spread = [](float grey, float dither) {
    const std::vector<std::uint8_t> rgb = tone_map(plain_image(64, grey), "none", 0.0F, false, dither).rgb;
    const auto [low, high] = std::minmax_element(rgb.begin(), rgb.end());
    return *high - *low;
  };
  const float half = linear_from_srgb(100.5F / 255.0F), whole = linear_from_srgb(100.0F / 255.0F);
  EXPECT_EQ(spread(half, 0.0F), 0);
  EXPECT_EQ(spread(half, 1.0F), 1);
  EXPECT_EQ(spread(half, 2.0F), 2);
  EXPECT_EQ(spread(whole, 0.9F), 0) << "a whole code is not moved";
  for (const float end : {0.0F, -1.0F, 1.0F, 9.0F}) EXPECT_EQ(spread(end, 1.0F), 0) << end;
}

/// A part of a picture is dithered as the whole is, on any number of threads.
TEST(Color, DitherIsAFunctionOfThePixel) {
  Image image(257, 190);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> light(0.0F, 1.2F);
  for (float& v : image.add("color", 3)) v = light(random);
  const std::vector<std::uint8_t> all = tone_map(image, "aces", 0.0F, false, 1.0F).rgb;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(tone_map(image, "aces", 0.0F, false, 1.0F).rgb, all);
  }
  const std::vector<std::uint8_t> plain = tone_map(image, "aces", 0.0F).rgb;
  EXPECT_EQ(tone_map(image, "aces", 0.0F, false, 0.0F).rgb, plain);
  int moved = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_LE(std::abs(all[i] - plain[i]), 1);
    moved += all[i] != plain[i] ? 1 : 0;
  }
  EXPECT_NEAR(moved / static_cast<double>(all.size()), 0.25, 0.06) << "the rest is nearer to its code";
}

TEST(Color, TransparentPicturesHaveTheColourOfWhatIsThere) {
  const Color seen(0.2F, 0.4F, 0.1F);
  Image image = image_of({seen, 0.25F * seen, 0.0F * seen, 1e-6F * seen});
  image.add("alpha", 1) = {1.0F, 0.25F, 0.0F, 1e-6F};
  for (const char* curve : {"none", "aces"}) {
    const Picture opaque = tone_map(image, curve, 0.5F);
    EXPECT_TRUE(opaque.alpha.empty());
    const Picture picture = tone_map(image, curve, 0.5F, true);
    EXPECT_EQ(picture.alpha, (std::vector<std::uint8_t>{255, 64, 0, 0}));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(picture.rgb[k], opaque.rgb[k]);
      EXPECT_EQ(picture.rgb[3 + k], opaque.rgb[k]);  // the curve sees the colour, not its part of the pixel
      EXPECT_EQ(picture.rgb[6 + k], opaque.rgb[6 + k]);
    }
  }
  EXPECT_THROW(tone_map(image_of({seen}), "none", 0.0F, true), SettingsError);
}

TEST(Color, ErrorsNameWhatIsKnown) {
  try {
    tone_map(image_of({Color(1.0F, 1.0F, 1.0F)}), "filmic", 0.0F);
    FAIL();
  } catch (const SettingsError& error) {
    EXPECT_STREQ(error.what(),
                 "render.tone_curve: unknown curve 'filmic'; known are none, reinhard, aces, pbr_neutral");
  }
  EXPECT_THROW(tone_map(Image(2, 2), "none", 0.0F), SettingsError);
}

}  // namespace color_test
}  // namespace lagomorph::render
