#include "sim/radial_basis.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace radial_basis_test {

struct Scattered {
  std::vector<Vec3> points;
  std::vector<double> values;
};

Scattered scattered(const std::function<double(const Vec3&)>& f, int n = 20) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Scattered s;
  for (int i = 0; i < n; ++i) {
    s.points.emplace_back(uniform(random), uniform(random), uniform(random));
    s.values.push_back(f(s.points.back()));
  }
  return s;
}

std::optional<double> radius_of(const std::string& kernel) {
  return kernel == "gaussian" ? std::optional(0.3) : std::nullopt;
}

TEST(RadialBasis, IsExactAtItsPointsWhateverTheKernelAndTheUnitOfLength) {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    for (const std::string& kernel : radial_kernel_names()) {
      Scattered s =
          scattered([](const Vec3& x) { return 1e5 * (1.0 + x.x() * x.y() + std::sin(9 * x.z())); });
      for (Vec3& x : s.points) x *= unit;
      std::optional<double> radius = radius_of(kernel);
      if (radius) radius = *radius * unit;
      const RadialBasis field(s.points, s.values, kernel, radius, "here");
      for (std::size_t i = 0; i < s.points.size(); ++i)
        EXPECT_NEAR(field(s.points[i]), s.values[i], 1e-10 * 1e5) << kernel;
    }
  }
}

TEST(RadialBasis, KeepsWhatItsPolynomialHolds) {
  const Vec3 somewhere(0.3, -2.0, 5.0);
  const auto linear = [](const Vec3& x) { return 3.0 + 2.0 * x.x() - x.y() + 0.5 * x.z(); };
  const Scattered s = scattered(linear), flat = scattered([](const Vec3&) { return 4.0; });
  EXPECT_NEAR(RadialBasis(s.points, s.values, "triharmonic", {}, "")(somewhere), linear(somewhere), 1e-10);
  EXPECT_NEAR(RadialBasis(flat.points, flat.values, "biharmonic", {}, "")(somewhere), 4.0, 1e-12);
  const RadialBasis gaussian(s.points, s.values, "gaussian", 0.3, "");
  double mean = 0.0;
  for (const double value : s.values) mean += value / static_cast<double>(s.values.size());
  EXPECT_NEAR(gaussian(Vec3(100, 0, 0)), mean, 1e-12);
}

/// With two points the biharmonic field is linear between them, and constant beyond: |x - a| - |x - b|.
TEST(RadialBasis, IsBickelsBiharmonicBetweenTwoPoints) {
  const RadialBasis field({Vec3(0, 0, 0), Vec3(2, 0, 0)}, {10.0, 30.0}, "biharmonic", {}, "");
  EXPECT_NEAR(field(Vec3(0.5, 0, 0)), 15.0, 1e-12);
  EXPECT_NEAR(field(Vec3(7, 0, 0)), 30.0, 1e-12);
  EXPECT_EQ(RadialBasis({Vec3(1, 2, 3)}, {5.0}, "biharmonic", {}, "")(Vec3(9, 9, 9)), 5.0);
}

TEST(RadialBasis, TellsWhatIsWrong) {
  const auto error = [](const std::vector<Vec3>& points, const std::vector<double>& values,
                        const std::string& kernel, std::optional<double> radius) {
    return error_of([&] { RadialBasis(points, values, kernel, radius, "here"); });
  };
  const std::vector<Vec3> line = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
  EXPECT_EQ(error(line, {1, 2}, "biharmonic", {}), "here: has 4 points and 2 values; give one value a point");
  EXPECT_EQ(error({Vec3(0, 1, 0), Vec3(0, 1, 0)}, {1, 2}, "biharmonic", {}),
            "here: points 0 and 1 are both at [0, 1, 0]; give each its own place");
  EXPECT_EQ(error(line, {1, 2, 3, 4}, "triharmonic", {}),
            "here: its points do not determine a field; triharmonic needs four that are not in a plane");
  EXPECT_EQ(error(line, {1, 2, 3, 4}, "gaussian", {}), "here: give a radius for kernel gaussian");
  EXPECT_EQ(error(line, {1, 2, 3, 4}, "biharmonic", 1.0), "here: radius belongs to kernel gaussian");
  EXPECT_EQ(error(line, {1, 2, 3, 4}, "cubic", {}),
            "here: unknown kernel 'cubic'; valid ones are biharmonic, triharmonic, gaussian");
}

}  // namespace radial_basis_test
}  // namespace lagomorph::sim
