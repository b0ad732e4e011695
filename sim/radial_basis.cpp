#include "sim/radial_basis.h"

#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "sim/error.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

constexpr std::size_t kMostPoints = 2000;  // the system is dense

void check_points(const std::vector<Vec3>& points, const std::vector<double>& values,
                  const std::string& where) {
  if (points.empty() || points.size() != values.size())
    throw InputError(where + ": has " + counted(static_cast<long long>(points.size()), "point") + " and " +
                     counted(static_cast<long long>(values.size()), "value") + "; give one value a point");
  if (points.size() > kMostPoints)
    throw InputError(where + ": has " + std::to_string(points.size()) + " points; " +
                     std::to_string(kMostPoints) + " are the most");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || !std::isfinite(values[i]))
      throw InputError(where + ": point " + std::to_string(i) + " at " + short_vector(points[i]) +
                       " with value " + short_number(values[i]) + " must be finite");
    for (std::size_t k = 0; k < i; ++k)
      if (points[i] == points[k])
        throw InputError(where + ": points " + std::to_string(k) + " and " + std::to_string(i) +
                         " are both at " + short_vector(points[i]) + "; give each its own place");
  }
}

}  // namespace

std::vector<std::string> radial_kernel_names() { return {"biharmonic", "triharmonic", "gaussian"}; }

RadialBasis::RadialBasis(std::vector<Vec3> points, const std::vector<double>& values,
                         const std::string& kernel, std::optional<double> radius, const std::string& where)
    : points_(std::move(points)) {
  const std::vector<std::string> names = radial_kernel_names();
  if (kernel == names[0]) {
    kernel_ = Kernel::biharmonic;
  } else if (kernel == names[1]) {
    kernel_ = Kernel::triharmonic;
  } else if (kernel == names[2]) {
    kernel_ = Kernel::gaussian;
  } else {
    throw InputError(where + ": unknown kernel '" + kernel +
                     "'; valid ones are biharmonic, triharmonic, gaussian");
  }
  if (radius.has_value() != (kernel_ == Kernel::gaussian))
    throw InputError(where + ": " + (radius ? "radius belongs to" : "give a radius for") +
                     " kernel gaussian");
  if (radius && !(*radius > 0.0 && std::isfinite(*radius)))
    throw InputError(where + ": radius = " + short_number(*radius) + " must be > 0 m");
  check_points(points_, values, where);

  for (const Vec3& x : points_) mean_ += x / static_cast<double>(points_.size());
  double extent = 0.0;
  for (const Vec3& x : points_) extent = std::max(extent, (x - mean_).norm());
  if (extent > 0.0) extent_ = extent;
  for (Vec3& x : points_) x = (x - mean_) / extent_;
  if (radius) radius_ = *radius / extent_;

  const auto n = static_cast<Eigen::Index>(points_.size());
  const Eigen::Index m = monomials();
  const auto point = [&](Eigen::Index i) -> const Vec3& { return points_[static_cast<std::size_t>(i)]; };
  Eigen::VectorXd f = Eigen::VectorXd::Zero(n + m);
  for (Eigen::Index i = 0; i < n; ++i) f[i] = values[static_cast<std::size_t>(i)];
  const double middle = f.head(n).mean();
  if (kernel_ == Kernel::gaussian) f.head(n).array() -= middle;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, n + m);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) A(i, k) = phi((point(i) - point(k)).norm());
    for (Eigen::Index k = 0; k < m; ++k) A(i, n + k) = A(n + k, i) = monomial(static_cast<int>(k), point(i));
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
  const Eigen::VectorXd solution = lu.solve(f);
  if (!lu.isInvertible() || !((A * solution - f).norm() <= 1e-8 * f.norm()))
    throw InputError(where + ": its points do not determine a field; " +
                     (kernel_ == Kernel::triharmonic ? "triharmonic needs four that are not in a plane"
                                                     : "give fewer that are near each other, or a smaller "
                                                       "radius"));
  weights_ = solution.head(n);
  polynomial_ = solution.tail(m);
  if (kernel_ == Kernel::gaussian) polynomial_ = Eigen::VectorXd::Constant(1, middle);
}

double RadialBasis::phi(double r) const {
  switch (kernel_) {
    case Kernel::biharmonic:
      return r;
    case Kernel::triharmonic:
      return r * r * r;
    case Kernel::gaussian:
      break;
  }
  return std::exp(-(r / radius_) * (r / radius_));
}

int RadialBasis::monomials() const {
  if (kernel_ == Kernel::gaussian) return 0;
  return kernel_ == Kernel::triharmonic ? 4 : 1;
}

double RadialBasis::monomial(int k, const Vec3& x) const { return k == 0 ? 1.0 : x[k - 1]; }

double RadialBasis::operator()(const Vec3& x) const {
  const Vec3 scaled = (x - mean_) / extent_;
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    sum += weights_[static_cast<Eigen::Index>(i)] * phi((scaled - points_[i]).norm());
  for (Eigen::Index k = 0; k < polynomial_.size(); ++k)
    sum += polynomial_[k] * monomial(static_cast<int>(k), scaled);
  return sum;
}

}  // namespace lagomorph::sim
