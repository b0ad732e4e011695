#include "sim/materials/stress_strain.h"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "sim/determinant.h"
#include "sim/error.h"
#include "sim/materials/parameters.h"
#include "sim/materials/stretches.h"
#include "sim/text.h"

namespace lagomorph::sim {

StressStrain StressStrain::from_settings(const MaterialSettings& s, const std::string& where) {
  if (s.mu || s.lambda || s.C || s.D || s.C10 || s.C01 || s.bulk || s.preset != "none")
    throw InputError(where + ": " + kName + " takes data, poisson and young, and no other constants");
  const double poisson = s.poisson.value_or(0.3), young = s.young.value_or(0.0);
  if (!(poisson >= 0.0 && poisson < 0.5))
    throw InputError(where + ": poisson = " + short_number(poisson) + " must be in [0, 0.5) for " + kName);
  if (s.young && !(young > 0.0 && std::isfinite(young)))
    throw InputError(where + ": young = " + short_number(young) + " must be > 0 Pa");
  return {std::make_shared<const StressStrainCurve>(s.data, young, poisson, where)};
}

double StressStrain::psi(const Mat3& F) const {
  const double J = determinant(F);
  if (!(J > 0.0)) return std::numeric_limits<double>::infinity();
  const Vec3 stretches = RotationSvd(F).sigma;
  double sum = 0.5 * curve->lambda() * std::log(J) * std::log(J);
  for (int i = 0; i < 3; ++i) sum += curve->at(std::log(stretches[i])).area;
  return sum;
}

Mat3 StressStrain::dpsi_dF(const Mat3& F) const {
  const RotationSvd svd(F);
  const Vec3& s = svd.sigma;
  const double k = curve->lambda() * std::log(determinant(F));
  const Vec3 P = s.unaryExpr([&](double stretch) { return (curve->at(std::log(stretch)).y + k) / stretch; });
  return svd.U * P.asDiagonal() * svd.V.transpose();
}

/// The eigenvectors that isotropic densities share: with ψ_i = ∂ψ/∂λ_i, a twist and a flip of each pair with
/// (ψ_i + ψ_j)/(λ_i + λ_j) and (ψ_i - ψ_j)/(λ_i - λ_j), and the span of the stretches with ∂²ψ/∂λ_i∂λ_j.
/// [Smith, de Goes, Kim 2019, "Analytic Eigensystems for Isotropic Distortion Energies"]
Mat9 StressStrain::hessian(const Mat3& F, bool projected) const {
  const RotationSvd svd(F);
  const Vec3& s = svd.sigma;
  const double k = curve->lambda() * std::log(determinant(F));
  Vec3 g, dg;  // G/λ and its derivative
  for (int i = 0; i < 3; ++i) {
    const HermiteCurve::Values w = curve->at(std::log(s[i]));
    g[i] = w.y / s[i];
    dg[i] = (w.slope - w.y) / (s[i] * s[i]);
  }
  Mat9 H = Mat9::Zero();
  const auto add = [&](double eigenvalue, const Mat3& q) {
    if (projected && !(eigenvalue > 0.0)) return;
    const Vec9 v = vec(svd.U * q * svd.V.transpose());
    H += eigenvalue * v * v.transpose();
  };
  Mat3 A;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) A(i, j) = curve->lambda() / (s[i] * s[j]);
    A(i, i) += dg[i] - k / (s[i] * s[i]);
  }
  for (int n = 0; n < 3; ++n) {
    const int i = (n + 1) % 3, j = (n + 2) % 3;
    const double sum = s[i] + s[j], difference = s[i] - s[j], middle = 0.5 * sum;
    double slope = (g[i] - g[j]) / difference;
    if (std::abs(difference) < 1e-5 * sum) {  // the quotient would lose digits; the slope there does not
      const HermiteCurve::Values w = curve->at(std::log(middle));
      slope = (w.slope - w.y) / (middle * middle);
    }
    Mat3 q = Mat3::Zero();
    q(i, j) = std::sqrt(0.5);
    q(j, i) = -q(i, j);
    add((g[i] + g[j] + k * sum / (s[i] * s[j])) / sum, q);
    q(j, i) = q(i, j);
    add(slope - k / (s[i] * s[j]), q);
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> stretches(A);
  for (int n = 0; n < 3; ++n) add(stretches.eigenvalues()[n], stretches.eigenvectors().col(n).asDiagonal());
  return H;
}

double StressStrain::stiffness() const {
  const Lame lame = lame_from_young(curve->largest_slope(), curve->poisson());
  return lame.mu + lame.lambda;
}

}  // namespace lagomorph::sim
