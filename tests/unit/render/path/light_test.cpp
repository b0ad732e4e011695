#include "render/path/light.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lagomorph::render::path {
namespace light_test {

constexpr double pi = std::numbers::pi;

/// A light at `height` above the origin that shines down, width along x.
AreaLight ceiling(float width, float depth, float height) {
  AreaLight light;
  light.position = Vec3(0.0F, height, 0.0F);
  light.look_at = Vec3::Zero();
  light.size = Vec2(width, depth);
  light.radiance = 1.0F;
  return light;
}

/// Solid angle of a rectangle a x b seen from h under one of its corners.
double corner_solid_angle(double a, double b, double h) {
  return std::atan2(a * b, h * std::sqrt(a * a + b * b + h * h));
}

/// Form factor from a point to a rectangle a x b parallel to its plane, h over one of its corners.
double corner_form_factor(double a, double b, double h) {
  const double p = std::sqrt(a * a + h * h), q = std::sqrt(b * b + h * h);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * pi);
}

/// Sum over the four rectangles between the foot of p and the corners, with signs.
template <class F>
double over_rectangle(const F& f, double x0, double x1, double y0, double y1, double h) {
  const auto corner = [&](double x, double y) {
    return std::copysign(1.0, x) * std::copysign(1.0, y) * f(std::abs(x), std::abs(y), h);
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

TEST(RectangleLight, DensityIsOneOverTheSolidAngle) {
  const RectangleLight light(ceiling(2.0F, 1.0F, 1.5F));
  for (const Vec3& p :
       {Vec3(0, 0, 0), Vec3(0.3F, 0.2F, -0.4F), Vec3(1.0F, 0.0F, 0.5F), Vec3(0.9F, 1.4F, 0.2F)}) {
    const double expected =
        over_rectangle(corner_solid_angle, -1.0 - p.x(), 1.0 - p.x(), -0.5 - p.z(), 0.5 - p.z(), 1.5 - p.y());
    EXPECT_NEAR(1.0 / light.sample(p, {0.4F, 0.7F}).pdf, expected, 1e-5 * expected + 1e-6);
  }
}

TEST(RectangleLight, SamplesLieOnItAndKnowTheirDensity) {
  AreaLight tilted;
  tilted.position = Vec3(1.0F, 2.0F, 3.0F);
  tilted.look_at = Vec3(0.2F, 0.1F, -0.3F);
  tilted.size = Vec2(1.2F, 0.7F);
  const RectangleLight light(tilted);
  const FrameSamples numbers(0, 0, 1024);
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.5F, 1.0F, 1.0F), Vec3(-20.0F, 1.0F, -30.0F)}) {
    for (int s = 0; s < 1024; ++s) {
      const RectangleLight::Sample to = light.sample(p, numbers.path(0, 0, s).pair(0));
      ASSERT_GT(to.pdf, 0.0F);
      // Just inside, lest rounding put a sample of the border beside it.
      const Vec3 point = p + to.distance * to.direction;
      const Vec3 inward = p + (tilted.position + 0.999F * (point - tilted.position) - p);
      const RectangleLight::Hit hit = light.intersect({p, (inward - p).normalized()});
      ASSERT_GT(hit.distance, 0.0F);
      EXPECT_NEAR(hit.distance, to.distance, 1e-3F * to.distance);
      EXPECT_NEAR(light.pdf(p, point), to.pdf, 1e-4F * to.pdf);
    }
  }
}

TEST(RectangleLight, SamplesAreUniformInSolidAngle) {
  // Close by, where uniform in area would be far off: each quarter of the rectangle gets its share of solid
  // angle.
  const RectangleLight light(ceiling(2.0F, 2.0F, 0.4F));
  const Vec3 p(-0.7F, 0.0F, -0.6F);
  const FrameSamples numbers(0, 0, 65536);
  double count[2][2] = {};
  for (int s = 0; s < 65536; ++s) {
    const RectangleLight::Sample to = light.sample(p, numbers.path(0, 0, s).pair(0));
    const Vec3 point = p + to.distance * to.direction;
    EXPECT_NEAR(point.y(), 0.4F, 1e-3F);
    ++count[point.x() > 0.0F ? 1 : 0][point.z() > 0.0F ? 1 : 0];
  }
  const auto angle = [&](double x0, double x1, double z0, double z1) {
    return over_rectangle(corner_solid_angle, x0 - p.x(), x1 - p.x(), z0 - p.z(), z1 - p.z(), 0.4);
  };
  const double total = angle(-1, 1, -1, 1);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      EXPECT_NEAR(count[i][j] / 65536.0, angle(i - 1.0, i, j - 1.0, j) / total, 2e-4) << i << j;
    }
  }
}

TEST(RectangleLight, IrradianceMeetsTheFormFactor) {
  // E = pi L F, near (by solid angle) and far (by area).
  for (const float height : {0.3F, 1.0F, 3.0F, 20.0F}) {
    const RectangleLight light(ceiling(1.5F, 1.0F, height));
    const FrameSamples numbers(0, 0, 65536);
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.5F, 0.0F, 0.3F), Vec3(2.0F, 0.0F, 1.0F)}) {
      double sum = 0.0;
      for (int s = 0; s < 65536; ++s) {
        const RectangleLight::Sample to = light.sample(p, numbers.path(0, 0, s).pair(0));
        sum += std::max(to.direction.y(), 0.0F) / to.pdf;
      }
      const double expected = pi * over_rectangle(corner_form_factor, -0.75 - p.x(), 0.75 - p.x(),
                                                  -0.5 - p.z(), 0.5 - p.z(), height);
      EXPECT_NEAR(sum / 65536.0, expected, 5e-4 * expected) << height << " " << p.transpose();
    }
  }
}

TEST(RectangleLight, ShinesFromOneSideOnly) {
  const RectangleLight light(ceiling(1.0F, 1.0F, 1.0F));
  const Vec3 behind(0.0F, 2.0F, 0.0F);
  EXPECT_EQ(light.sample(behind, {0.5F, 0.5F}).pdf, 0.0F);
  EXPECT_EQ(light.intersect({behind, Vec3(0, -1, 0)}).distance, 0.0F);
  EXPECT_GT(light.intersect({Vec3::Zero(), Vec3(0, 1, 0)}).distance, 0.0F);
  EXPECT_EQ(light.intersect({Vec3(0.6F, 0.0F, 0.0F), Vec3(0, 1, 0)}).distance, 0.0F);
  EXPECT_EQ(light.intersect({Vec3(0.0F, 0.0F, 0.0F), Vec3(0, -1, 0)}).distance, 0.0F);
}

}  // namespace light_test
}  // namespace lagomorph::render::path
