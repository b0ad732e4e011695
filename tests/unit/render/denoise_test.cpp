#include "render/denoise.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "render/backends.h"
#include "render/error.h"
#include "tests/unit/render/path/lit_sphere.h"

namespace lagomorph::render {
namespace denoise_test {

constexpr int width = 48;
constexpr int height = 40;

/// A picture in full, with noise of a known variance laid over it.
struct Picture {
  std::vector<float> clean, noisy, variance, albedo, normal, depth;
  NoisyPicture view() const { return {width, height, noisy, variance, albedo, normal, depth}; }
};

struct Pixel {
  Color color = Color::Constant(0.5F), albedo = Color::Constant(0.8F);
  Vec3 normal = Vec3::UnitZ();
  float depth = 2.0F;
};

Picture make(float deviation, const std::function<Pixel(int, int)>& at) {
  Picture p;
  std::mt19937 random(7);
  std::normal_distribution<float> normal(0.0F, 1.0F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Pixel pixel = at(x, y);
      for (int c = 0; c < 3; ++c) {
        p.clean.push_back(pixel.color[c]);
        p.noisy.push_back(pixel.color[c] + deviation * normal(random));
        p.variance.push_back(deviation * deviation);
        p.albedo.push_back(pixel.albedo[c]);
        p.normal.push_back(pixel.normal[c]);
      }
      p.depth.push_back(pixel.depth);
    }
  }
  return p;
}

double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - b[i], 2.0);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

float red(const std::vector<float>& picture, int x, int y) {
  return picture[3 * static_cast<std::size_t>(y * width + x)];
}

TEST(Denoise, LeavesAFifthOfTheNoiseOfAnEvenSurface) {
  const Picture p = make(0.1F, [](int, int) { return Pixel(); });
  EXPECT_NEAR(rms(p.noisy, p.clean), 0.1, 0.005);
  EXPECT_LT(rms(denoise(p.view(), {}), p.clean), 0.02);
}

/// A picture without noise has nothing that could be taken from it, whatever is in it.
TEST(Denoise, LeavesWhatHasNoNoise) {
  const Picture p = make(0.0F, [](int x, int y) {
    Pixel pixel;
    pixel.color = Color(0.5F + 0.4F * std::sin(0.9F * static_cast<float>(x * y)), x < 20 ? 0.1F : 0.9F, 0.3F);
    return pixel;
  });
  EXPECT_LT(rms(denoise(p.view(), {}), p.clean), 1e-3);
}

/// An edge of the light that goes with an edge of a guide stays within its pixel.
TEST(Denoise, KeepsEdgesOfNormalsAlbedoAndDepthSharp) {
  for (int kind = 0; kind < 3; ++kind) {
    const Picture p = make(0.05F, [&](int x, int) {
      Pixel pixel;
      if (x < 24) return pixel;
      pixel.color = Color::Constant(0.6F);
      if (kind == 0) pixel.normal = Vec3(0.6F, 0.0F, 0.8F);
      if (kind == 1) pixel.albedo = Color::Constant(0.95F);
      if (kind == 2) pixel.depth = 3.0F;
      return pixel;
    });
    const std::vector<float> found = denoise(p.view(), {});
    double left = 0.0, right = 0.0;
    for (int y = 0; y < height; ++y) left += red(found, 23, y) / height, right += red(found, 24, y) / height;
    EXPECT_NEAR(left, 0.5, 0.02) << kind;
    EXPECT_NEAR(right, 0.6, 0.02) << kind;
  }
}

/// The edge of a hard shadow, of which no guide tells, where it stands out of the noise.
TEST(Denoise, KeepsTheEdgeOfAShadow) {
  const Picture p = make(0.05F, [](int x, int) {
    Pixel pixel;
    pixel.color = Color::Constant(x < 24 ? 0.1F : 0.8F);
    return pixel;
  });
  const std::vector<float> found = denoise(p.view(), {});
  double left = 0.0, right = 0.0;
  for (int y = 0; y < height; ++y) left += red(found, 23, y) / height, right += red(found, 24, y) / height;
  EXPECT_NEAR(left, 0.1, 0.02);
  EXPECT_NEAR(right, 0.8, 0.02);
}

/// Light that is linear in the normal, as of a wide sky, is what the fit is for.
TEST(Denoise, FollowsLightThatTurnsWithTheNormal) {
  const Picture p = make(0.1F, [](int x, int) {
    Pixel pixel;
    const float angle = 0.02F * static_cast<float>(x - width / 2);
    pixel.normal = Vec3(std::sin(angle), 0.0F, std::cos(angle));
    pixel.color = Color::Constant(0.5F + 0.4F * std::sin(angle));
    return pixel;
  });
  EXPECT_LT(rms(denoise(p.view(), {}), p.clean), 0.03);
}

TEST(Denoise, KeepsTheLightOfTheWhole) {
  const Picture p = make(0.2F, [](int, int) { return Pixel(); });
  double before = 0.0, after = 0.0;
  for (const float v : p.noisy) before += v;
  for (const float v : denoise(p.view(), {})) after += v;
  EXPECT_NEAR(after / before, 1.0, 0.01);
}

TEST(Denoise, TakesPixelsThatSeeNothing) {
  const Picture p = make(0.05F, [](int x, int) {
    Pixel pixel;
    if (x < 24) return pixel;
    pixel.normal.setZero();
    pixel.albedo.setZero();
    pixel.depth = std::numeric_limits<float>::infinity();
    pixel.color = Color::Zero();
    return pixel;
  });
  for (const float v : denoise(p.view(), {})) EXPECT_TRUE(std::isfinite(v) && v >= 0.0F);
}

TEST(Denoise, TellsWhatIsWrong) {
  const Picture p = make(0.1F, [](int, int) { return Pixel(); });
  NoisyPicture view = p.view();
  view.depth = view.depth.subspan(1);
  EXPECT_THROW(denoise(view, {}), SettingsError);
  EXPECT_THROW(denoise({}, {}), SettingsError);
  EXPECT_THROW(denoise(p.view(), {.radius = 0}), SettingsError);
  EXPECT_THROW(denoise(p.view(), {.patch_radius = 9}), SettingsError);
  EXPECT_THROW(denoise(p.view(), {.strength = 0.0F}), SettingsError);
}

RenderSettings settings(int samples, bool denoised) {
  RenderSettings s = lit_sphere_settings(samples);
  s.path.denoise = denoised;
  return s;
}

Image draw(const RenderSettings& s, int threads = 2) { return draw_lit_sphere(lit_sphere(), s, threads); }

const std::vector<float>& color(const Image& image) { return image.find(color_channel)->values; }

/// Small as the picture is, and so mostly edges.
TEST(Denoise, HalvesTheErrorOfAFewSamples) {
  const Image reference = draw(settings(1024, false));
  const double noisy = rms(color(draw(settings(8, false))), color(reference));
  const double denoised = rms(color(draw(settings(8, true))), color(reference));
  EXPECT_LT(denoised, 0.5 * noisy) << "of " << noisy;
}

TEST(Denoise, GivesTheSameBytesForAnyNumberOfThreads) {
  EXPECT_EQ(color(draw(settings(4, true), 1)), color(draw(settings(4, true), 2)));
}

TEST(Denoise, WantsSamplesToLearnTheNoiseFrom) { EXPECT_THROW(draw(settings(1, true)), SettingsError); }

/// Its guides are no channels of the picture unless they are asked for, and are then what they are without
/// it.
TEST(Denoise, KeepsItsGuidesToItself) {
  EXPECT_EQ(draw(settings(4, true)).channels().size(), 1U);
  RenderSettings with = settings(4, true), without = settings(4, false);
  with.channels = without.channels = {variance_channel};
  EXPECT_EQ(draw(with).find(variance_channel)->values, draw(without).find(variance_channel)->values);
}

}  // namespace denoise_test
}  // namespace lagomorph::render
