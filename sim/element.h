#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <numeric>

#include "sim/element_matrix.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// What integrates over one element of N nodes by P points: ∫ f dX ≈ Σ_p volumes[p] f(X_p).
template <int N, int P>
struct ElementRule {
  std::array<int, N> nodes;  // ascending
  std::array<InnerGradients<N>, P>
      D;  // ∂φ/∂X at each point, in the order of `nodes`, but for the first [1/m]
  std::array<double, P> volumes;  // weights times the volume [m^3]
};

/// F at each point, at positions q. The rows of D sum to zero, so the first node may be taken off.
template <int N, int P>
std::array<Mat3, P> deformation_gradients(const ElementRule<N, P>& rule, const VecX& q) {
  Eigen::Matrix<double, 3, N - 1> x;
  for (std::size_t a = 1; a < N; ++a)
    x.col(static_cast<Eigen::Index>(a) - 1) =
        q.segment<3>(3 * rule.nodes[a]) - q.segment<3>(3 * rule.nodes[0]);
  std::array<Mat3, P> F;
  for (std::size_t p = 0; p < P; ++p) F[p] = x * rule.D[p];
  return F;
}

/// An element of the mesh: its number of nodes, its quadrature, and the shape functions' gradients there.
template <class Element>
concept FiniteElement = requires(const TetMesh& mesh, std::size_t tet) {
  { Element::kNodes } -> std::convertible_to<int>;
  { Element::kPoints } -> std::convertible_to<int>;
  /// The polynomials that the rule integrates exactly.
  { Element::kDegree } -> std::convertible_to<int>;
  { Element::rule(mesh, tet) } -> std::same_as<ElementRule<Element::kNodes, Element::kPoints>>;
};

/// The linear tet of the lecture. D is constant, so that one point, of degree 1, integrates every ψ(F)
/// exactly.
struct Tet4 {
  static constexpr int kNodes = 4, kPoints = 1, kDegree = 1;

  static ElementRule<4, 1> rule(const TetMesh& mesh, std::size_t tet) {
    ElementRule<4, 1> rule;
    rule.nodes = mesh.tets[tet];
    std::sort(rule.nodes.begin(), rule.nodes.end());  // whatever the orientation
    TetCorners X;
    for (std::size_t a = 0; a < 4; ++a) X.col(static_cast<Eigen::Index>(a)) = mesh.X.row(rule.nodes[a]);
    rule.D[0] = dphi_dX(X).bottomRows<3>();
    rule.volumes[0] = std::abs(tet_volume(X));
    return rule;
  }
};

/// The quadratic tet: φ_a = λ_a (2 λ_a - 1) at the corners and 4 λ_a λ_b on the edges, λ the barycentric
/// coordinates. Its F is linear in X where its edges are straight, so that four points, of degree 2,
/// integrate a quadratic ψ, and with it the stiffness near rest, exactly; they give the matrix its full rank,
/// 24 = 30 - 6, and so leave no motion without energy. Rules of higher degree only cost time: what a
/// non-quadratic ψ loses is of the order of the element's own error. [Zienkiewicz and Taylor, "The Finite
/// Element Method", table of tetrahedral rules]
struct Tet10 {
  static constexpr int kNodes = 10, kPoints = 4, kDegree = 2;

  static ElementRule<10, 4> rule(const TetMesh& mesh, std::size_t tet) {
    const std::array<int, 10> nodes = nodes_of(mesh, tet);
    Eigen::Matrix<double, 3, 10> X;
    for (std::size_t a = 0; a < 10; ++a) X.col(static_cast<Eigen::Index>(a)) = mesh.X.row(nodes[a]);
    std::array<int, 10> order;  // of ascending nodes
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return at(nodes, a) < at(nodes, b); });
    ElementRule<10, 4> rule;
    for (std::size_t a = 0; a < 10; ++a) rule.nodes[a] = at(nodes, order[a]);
    for (int p = 0; p < 4; ++p) {
      const Eigen::Matrix<double, 10, 3> local = dphi_dxi(point(p));
      const Mat3 T = X * local;  // ∂X/∂ξ
      const Eigen::Matrix<double, 10, 3> D = local * T.inverse();
      for (int a = 1; a < 10; ++a) rule.D[static_cast<std::size_t>(p)].row(a - 1) = D.row(at(order, a));
      rule.volumes[static_cast<std::size_t>(p)] = std::abs(T.determinant()) / 24.0;
    }
    return rule;
  }

  /// Corners, then midside nodes.
  static std::array<int, 10> nodes_of(const TetMesh& mesh, std::size_t tet) {
    std::array<int, 10> nodes;
    std::copy(mesh.tets[tet].begin(), mesh.tets[tet].end(), nodes.begin());
    std::copy(mesh.midsides[tet].begin(), mesh.midsides[tet].end(), nodes.begin() + 4);
    return nodes;
  }

  /// Barycentric coordinates of point p: (5 + 3 √5)/20 of corner p, (5 - √5)/20 of the others.
  static Eigen::Vector4d point(int p) {
    const double root = std::sqrt(5.0);
    Eigen::Vector4d lambda = Eigen::Vector4d::Constant((5.0 - root) / 20.0);
    lambda[p] = (5.0 + 3.0 * root) / 20.0;
    return lambda;
  }

  /// At barycentric coordinates λ, the weights of the points' values in the linear function through them:
  /// (λ_p - b)/(a - b), a of a point's own corner and b of the others.
  static Eigen::Vector4d weights_of_points(const Eigen::Vector4d& lambda) {
    const double root = std::sqrt(5.0);
    return root * lambda - Eigen::Vector4d::Constant((root - 1.0) / 4.0);
  }

  /// Barycentric coordinates of node a of nodes_of().
  static Eigen::Vector4d node(int a) {
    if (a < 4) return Eigen::Vector4d::Unit(a);
    return 0.5 * (Eigen::Vector4d::Unit(edge(a - 4)[0]) + Eigen::Vector4d::Unit(edge(a - 4)[1]));
  }

  /// The ten shape functions at barycentric coordinates λ.
  static Eigen::Matrix<double, 10, 1> phi(const Eigen::Vector4d& lambda) {
    Eigen::Matrix<double, 10, 1> phi;
    for (int a = 0; a < 4; ++a) phi[a] = lambda[a] * (2.0 * lambda[a] - 1.0);
    for (int e = 0; e < 6; ++e) phi[4 + e] = 4.0 * lambda[edge(e)[0]] * lambda[edge(e)[1]];
    return phi;
  }

  /// ∂φ/∂ξ, ξ_k = λ_{k+1}, 10×3.
  static Eigen::Matrix<double, 10, 3> dphi_dxi(const Eigen::Vector4d& lambda) {
    Eigen::Matrix<double, 4, 3> dlambda;
    dlambda << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    Eigen::Matrix<double, 10, 3> d;
    for (int a = 0; a < 4; ++a) d.row(a) = (4.0 * lambda[a] - 1.0) * dlambda.row(a);
    for (int e = 0; e < 6; ++e) {
      const int a = edge(e)[0], b = edge(e)[1];
      d.row(4 + e) = 4.0 * (lambda[a] * dlambda.row(b) + lambda[b] * dlambda.row(a));
    }
    return d;
  }

private:
  static const std::array<int, 2>& edge(int e) { return kTetEdges[static_cast<std::size_t>(e)]; }
  static int at(const std::array<int, 10>& of, int i) { return of[static_cast<std::size_t>(i)]; }
};

}  // namespace lagomorph::sim
