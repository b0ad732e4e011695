#include "sim/materials/mooney_rivlin.h"

namespace lagomorph::sim {

namespace {

/// ψ = a I_1 + b I_2 + c(J) with a = C10 J^(-2/3), b = C01 J^(-4/3): its derivatives by I_1, I_2 and J. [Pa]
struct Partial {
  double one, two, J;     // ψ_1, ψ_2, ψ_J
  double oneJ, twoJ, JJ;  // the second ones that are not zero
  Partial(const MooneyRivlin& m, double I_1, double I_2, double det) {
    const double cbrt = std::cbrt(det), a = m.C10 / (cbrt * cbrt), b = m.C01 / (cbrt * cbrt * cbrt * cbrt);
    one = a;
    two = b;
    oneJ = -2.0 / 3.0 * a / det;
    twoJ = -4.0 / 3.0 * b / det;
    J = oneJ * I_1 + twoJ * I_2 + m.bulk * (det - 1.0);
    JJ = (10.0 / 9.0 * a * I_1 + 28.0 / 9.0 * b * I_2) / (det * det) + m.bulk;
  }
};

/// A × B with (A × B)_ij = ε_imn ε_jpq A_mp B_nq: ∂²J/∂F² at A times B. [Bonet, Gil, Ortigosa 2015, "A
/// computational framework for polyconvex large strain elasticity"]
Mat3 cross(const Mat3& A, const Mat3& B) {
  Mat3 result = Mat3::Zero();
  for_each_second_derivative_of_J(
      A, [&](int row, int column, double x) { result(row / 3, row % 3) += x * B(column / 3, column % 3); });
  return result;
}

/// ∂²J/∂F² at A as a matrix.
Mat9 cross_matrix(const Mat3& A) {
  Mat9 X = Mat9::Zero();
  for_each_second_derivative_of_J(A, [&](int row, int column, double x) { X(row, column) = x; });
  return X;
}

}  // namespace

double MooneyRivlin::psi(const Mat3& F) const {
  const double J = determinant(F);
  if (!(J > 0.0)) return std::numeric_limits<double>::infinity();
  const double cbrt = std::cbrt(J), two_thirds = cbrt * cbrt;
  return C10 * (F.squaredNorm() / two_thirds - 3.0) +
         C01 * (cofactor(F).squaredNorm() / (two_thirds * two_thirds) - 3.0) +
         0.5 * bulk * (J - 1.0) * (J - 1.0);
}

/// P = 2 ψ_1 F + 2 ψ_2 F × G + ψ_J G with G = cof F: ∂I_2/∂F = 2 ∂²J/∂F² : G.
Mat3 MooneyRivlin::dpsi_dF(const Mat3& F) const {
  const Mat3 G = cofactor(F);
  const Partial d(*this, F.squaredNorm(), G.squaredNorm(), determinant(F));
  return 2.0 * d.one * F + 2.0 * d.two * cross(F, G) + d.J * G;
}

/// With f = vec(F), g = vec(G), h = vec(F × G) and X(A) = ∂²J/∂F² at A: 2 ψ_1 1 + 2 ψ_2 (X(F)² + X(G)) +
/// ψ_J X(F) + ψ_JJ g gᵀ + 2 ψ_1J (f gᵀ + g fᵀ) + 2 ψ_2J (h gᵀ + g hᵀ).
Mat9 MooneyRivlin::d2psi_dF2(const Mat3& F) const {
  const Mat3 G = cofactor(F);
  const Partial d(*this, F.squaredNorm(), G.squaredNorm(), determinant(F));
  const Vec9 g = vec(G), mixed = 2.0 * d.oneJ * vec(F) + 2.0 * d.twoJ * vec(cross(F, G));
  const Mat9 X = cross_matrix(F);
  Mat9 H = 2.0 * d.two * (X * X + cross_matrix(G)) + d.J * X + d.JJ * g * g.transpose() +
           mixed * g.transpose() + g * mixed.transpose();
  H.diagonal().array() += 2.0 * d.one;
  return H;
}

Mat9 MooneyRivlin::projected_d2psi_dF2(const Mat3& F) const {
  const RotationSvd svd(F);
  const Vec3 &s = svd.sigma, g = svd.cofactors();
  const Partial d(*this, s.squaredNorm(), g.squaredNorm(), determinant(F));
  Vec3 mixed;
  StretchEigensystem eigen;
  for (int k = 0; k < 3; ++k) {
    const double a = s[(k + 1) % 3], b = s[(k + 2) % 3];
    mixed[k] = 2.0 * d.oneJ * s[k] + 2.0 * d.twoJ * s[k] * (a * a + b * b);
    eigen.twist[k] = 2.0 * d.one + 2.0 * d.two * (s[k] * s[k] + a * b) + d.J * s[k];
    eigen.flip[k] = 2.0 * d.one + 2.0 * d.two * (s[k] * s[k] - a * b) - d.J * s[k];
  }
  eigen.scaling = d.JJ * g * g.transpose() + mixed * g.transpose() + g * mixed.transpose();
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    eigen.scaling(k, k) += 2.0 * d.one + 2.0 * d.two * (s[i] * s[i] + s[j] * s[j]);
    eigen.scaling(i, j) += 4.0 * d.two * s[i] * s[j] + d.J * s[k];
    eigen.scaling(j, i) += 4.0 * d.two * s[i] * s[j] + d.J * s[k];
  }
  return without_negative_eigenvalues(d2psi_dF2(F), svd, eigen);
}

}  // namespace lagomorph::sim
