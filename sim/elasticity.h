#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "sim/compensated_sum.h"
#include "sim/element_matrix.h"
#include "sim/energy.h"
#include "sim/inversion.h"
#include "sim/kinematics.h"
#include "sim/materials/energy_density.h"
#include "sim/parallel.h"
#include "sim/stress_source.h"
#include "sim/tet_gather.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// V = Σ_j vol_j ψ(F_j) over some of a mesh's tets, with a material of its own for each of them. (lecture,
/// "Potential energy")
template <EnergyDensity Material>
class Elasticity : public Energy, public StressSource {
public:
  /// `elements` are tets of the mesh, `materials` theirs; `pattern` is that of the whole mesh.
  Elasticity(const TetMesh& mesh, const std::vector<int>& elements, std::vector<Material> materials,
             const std::shared_ptr<const BlockPattern>& pattern)
      : Elasticity(make_elements(mesh, elements), std::move(materials), pattern) {}

  std::string_view name() const override { return Material::kName; }

  double value(const VecX& q) const override {
    std::vector<double> energy(elements_.size());
    for_each_element(kCheap,
                     [&](std::size_t j) { energy[j] = elements_[j].volume * materials_[j].psi(F(j, q)); });
    CompensatedSum sum;
    for (const double e : energy) sum.add(e);
    return sum.value();
  }

  /// ψ is small only by what its terms take off each other, each of the size of the moduli.
  double value_scale(const VecX&) const override { return stiffness_volume_; }

  /// f_j = -vol_j B_jᵀ vec(∂ψ/∂F); the part of corner a of its negative is vol_j (∂ψ/∂F) D_a.
  void add_gradient(const VecX& q, double scale, VecX& g) const override {
    std::vector<double> vectors(TetGather::kVectorSize * elements_.size());
    for_each_element(kCheap, [&](std::size_t j) {
      Eigen::Map<TetCorners> g_j(vectors.data() + TetGather::kVectorSize * j);
      g_j.rightCols<3>() =
          elements_[j].volume * materials_[j].dpsi_dF(F(j, q)) * elements_[j].D123.transpose();
      g_j.col(0) = -g_j.rightCols<3>().rowwise().sum();
    });
    gather_.add_vectors(vectors, scale, g);
  }

  /// K_j = vol_j B_jᵀ (∂²ψ/∂F²) B_j.
  void add_hessian(const VecX& q, double scale, HessianKind kind, BlockHessian& H) const override {
    std::vector<double>& matrices = H.scratch();
    matrices.resize(TetGather::kMatrixSize * elements_.size());
    for_each_element(kDear, [&](std::size_t j) {
      const Mat3 F_j = F(j, q);
      const bool exact = kind == HessianKind::exact;
      const Mat9 h = elements_[j].volume *
                     (exact ? materials_[j].d2psi_dF2(F_j) : materials_[j].projected_d2psi_dF2(F_j));
      element_blocks(h, elements_[j].D123, matrices.data() + TetGather::kMatrixSize * j);
    });
    gather_.add_matrices(matrices, scale, H);
  }

  double max_step(const VecX& q, const VecX& dq) const override {
    if constexpr (Material::kNeedsPositiveJ) {
      std::vector<double> steps(elements_.size());
      for_each_element(kCheap, [&](std::size_t j) { steps[j] = step_without_inversion(F(j, q), F(j, dq)); });
      double smallest = 1.0;
      for (const double s : steps) smallest = std::min(smallest, s);
      return smallest;
    } else {
      return 1.0;
    }
  }

  void add_states(const VecX& q, ElementStates& states) const override {
    for_each_element(kCheap, [&](std::size_t j) {
      const Mat3 F_j = F(j, q);
      const auto tet = static_cast<std::size_t>(elements_[j].tet);
      states.P[tet] += materials_[j].dpsi_dF(F_j);
      states.psi[tet] += materials_[j].psi(F_j);
      states.stiffness[tet] += materials_[j].stiffness();
    });
  }

private:
  static constexpr int kCheap = 256, kDear = 64;  // elements a task

  struct Element {
    Tet corners;    // ascending, whatever the orientation
    Mat3 D123;      // the rows of D of the last three corners [1/m]
    double volume;  // [m^3]
    int tet;        // of the mesh
  };

  Elasticity(std::vector<Element> elements, std::vector<Material> materials,
             const std::shared_ptr<const BlockPattern>& pattern)
      : elements_(std::move(elements)),
        materials_(std::move(materials)),
        gather_(corners_of(elements_), pattern) {
    for (std::size_t j = 0; j < elements_.size(); ++j)
      stiffness_volume_ += elements_[j].volume * materials_[j].stiffness();
  }

  static std::vector<Element> make_elements(const TetMesh& mesh, const std::vector<int>& tets) {
    std::vector<Element> elements;
    elements.reserve(tets.size());
    for (const int j : tets) {
      Element e;
      e.corners = mesh.tets[static_cast<std::size_t>(j)];
      std::sort(e.corners.begin(), e.corners.end());
      TetCorners X;
      for (int a = 0; a < 4; ++a) X.col(a) = mesh.X.row(e.corners[a]).transpose();
      e.D123 = dphi_dX(X).bottomRows<3>();
      e.volume = std::abs(tet_volume(X));
      e.tet = j;
      elements.push_back(e);
    }
    return elements;
  }

  static std::vector<Tet> corners_of(const std::vector<Element>& elements) {
    std::vector<Tet> tets;
    tets.reserve(elements.size());
    for (const Element& e : elements) tets.push_back(e.corners);
    return tets;
  }

  /// Deformation gradient of element j; of a displacement, the change of it.
  Mat3 F(std::size_t j, const VecX& q) const {
    return edge_matrix(gather_corners(q, elements_[j].corners)) * elements_[j].D123;
  }

  template <class Body>
  void for_each_element(int grain, Body&& body) const {
    parallel_for(static_cast<int>(elements_.size()), grain, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) body(static_cast<std::size_t>(j));
    });
  }

  std::vector<Element> elements_;
  std::vector<Material> materials_;
  TetGather gather_;
  double stiffness_volume_ = 0.0;  // Σ vol_j · stiffness [J]
};

}  // namespace lagomorph::sim
