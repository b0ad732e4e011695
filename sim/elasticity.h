#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "sim/compensated_sum.h"
#include "sim/element.h"
#include "sim/energy.h"
#include "sim/invariant_blocks.h"
#include "sim/inversion.h"
#include "sim/materials/energy_density.h"
#include "sim/morton_order.h"
#include "sim/parallel.h"
#include "sim/stress_source.h"
#include "sim/tet_gather.h"
#include "sim/tet_lanes.h"
#include "sim/tet_mesh.h"

namespace lagomorph::sim {

/// V = Σ_j Σ_p vol_jp ψ(F_jp) over some of a mesh's tets and the quadrature points of each, with a material
/// of its own for each of them. (lecture, "Potential energy")
template <EnergyDensity Material, FiniteElement Element = Tet4>
class Elasticity : public Energy, public StressSource {
public:
  /// `elements` are tets of the mesh, `materials` theirs; `pattern` is that of the whole mesh. They are kept
  /// in an order of their own.
  Elasticity(const TetMesh& mesh, const std::vector<int>& elements, const std::vector<Material>& materials,
             const std::shared_ptr<const BlockPattern>& pattern)
      : Elasticity(mesh, elements, materials, morton_order(mesh, elements), pattern) {}

  std::string_view name() const override { return Material::kName; }

  double value(const VecX& q) const override {
    if constexpr (kInLanes) {
      std::vector<TetLanes::Lane> energies(lanes_.group_count());
      for_each_group([&](std::size_t group) { set_energies(group, q, energies[group]); });
      return TetLanes::sum(energies);
    }
    std::vector<double> energy(elements_.size());
    for_each_element([&](std::size_t j) {
      const Edges x = edges(j, q);
      for (std::size_t p = 0; p < P; ++p)
        energy[j] += elements_[j].volumes[p] * materials_[j].psi(x * elements_[j].D[p]);
    });
    CompensatedSum sum;
    for (const double e : energy) sum.add(e);
    return sum.value();
  }

  /// ψ is small only by what its terms take off each other, each of the size of the moduli.
  double value_scale(const VecX&) const override { return stiffness_volume_; }

  /// f_j = -Σ_p vol_jp B_jpᵀ vec(∂ψ/∂F); the part of node a of its negative is Σ_p vol_jp (∂ψ/∂F) D_a.
  void add_gradient(const VecX& q, double scale, VecX& g) const override {
    gather_.add_vectors(scale, g, [&](int begin, int end, double* vectors) {
      if constexpr (kInLanes) {
        set_groups(begin, end, q, kVectorSize, vectors,
                   [&](auto&&... of_group) { lanes_.set_vectors(of_group...); });
      } else {
        for (int j = begin; j < end; ++j, vectors += kVectorSize)
          set_vector(static_cast<std::size_t>(j), q, vectors);
      }
    });
  }

  /// K_j = Σ_p vol_jp B_jpᵀ (∂²ψ/∂F²) B_jp.
  void add_hessian(const VecX& q, double scale, HessianKind kind, BlockHessian& H) const override {
    gather_.add_matrices(scale, H, [&](int begin, int end, double* matrices) {
      if constexpr (kInLanes) {
        if (kind == HessianKind::exact) {
          set_groups(begin, end, q, kMatrixSize, matrices,
                     [&](auto&&... of_group) { lanes_.set_matrices(of_group...); });
          return;
        }
      }
      for (int j = begin; j < end; ++j)
        set_matrix(static_cast<std::size_t>(j), q, kind,
                   matrices + kMatrixSize * static_cast<std::size_t>(j - begin));
    });
  }

  /// No quadrature point may invert.
  double max_step(const VecX& q, const VecX& dq) const override {
    if constexpr (Material::kNeedsPositiveJ) {
      std::vector<double> steps(elements_.size(), 1.0);
      for_each_element([&](std::size_t j) {
        const Edges x = edges(j, q), dx = edges(j, dq);
        for (const auto& D : elements_[j].D)
          steps[j] = std::min(steps[j], step_without_inversion(x * D, dx * D));
      });
      double smallest = 1.0;
      for (const double s : steps) smallest = std::min(smallest, s);
      return smallest;
    } else {
      return 1.0;
    }
  }

  void add_states(const VecX& q, PointStates& states) const override {
    for_each_element([&](std::size_t j) {
      const Edges x = edges(j, q);
      const std::size_t first = states.first[static_cast<std::size_t>(tets_[j])];
      for (std::size_t p = 0; p < P; ++p) {
        const Mat3 F = x * elements_[j].D[p];
        states.P[first + p] += materials_[j].dpsi_dF(F);
        states.psi[first + p] += materials_[j].psi(F);
      }
    });
  }

  void add_moduli(ElementModuli& moduli) const override {
    for_each_element([&](std::size_t j) {
      const auto tet = static_cast<std::size_t>(tets_[j]);
      const Mat9 C = materials_[j].d2psi_dF2(Mat3::Identity());
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
          const int ik = 3 * i + k;
          moduli.C_iijj[tet] += C(4 * i, 4 * k);
          moduli.C_ijij[tet] += 0.5 * (C(ik, ik) + C(ik, 3 * k + i));
        }
      }
    });
  }

private:
  static constexpr int N = Element::kNodes;
  static constexpr std::size_t P = Element::kPoints;
  static constexpr std::size_t kVectorSize = TetGather::vector_size(N),
                               kMatrixSize = TetGather::matrix_size(N);
  static constexpr int kCheap = 256;  // elements a task
  /// Linear tets of a density of the invariants go eight at a time.
  static constexpr bool kInLanes = N == 4 && P == 1 && requires(const Material& m, const Invariants& inv) {
    m.psi(inv);
    m.derivatives(inv);
  };
  using Rule = ElementRule<N, Element::kPoints>;
  using Edges = Eigen::Matrix<double, 3, N - 1>;

  Elasticity(const TetMesh& mesh, const std::vector<int>& elements, const std::vector<Material>& materials,
             const std::vector<std::size_t>& order, const std::shared_ptr<const BlockPattern>& pattern)
      : tets_(in_order(elements, order)),
        elements_(make_elements(mesh, tets_)),
        materials_(in_order(materials, order)),
        gather_(nodes_of(elements_), N, pattern) {
    if constexpr (kInLanes) lanes_ = TetLanes(elements_);
    for (std::size_t j = 0; j < elements_.size(); ++j)
      for (const double volume : elements_[j].volumes)
        stiffness_volume_ += volume * materials_[j].stiffness();
  }

  template <class T>
  static std::vector<T> in_order(const std::vector<T>& all, const std::vector<std::size_t>& order) {
    std::vector<T> ordered;
    ordered.reserve(order.size());
    for (const std::size_t i : order) ordered.push_back(all[i]);
    return ordered;
  }

  static std::vector<Rule> make_elements(const TetMesh& mesh, const std::vector<int>& tets) {
    std::vector<Rule> elements;
    elements.reserve(tets.size());
    for (const int j : tets) elements.push_back(Element::rule(mesh, static_cast<std::size_t>(j)));
    return elements;
  }

  static std::vector<int> nodes_of(const std::vector<Rule>& elements) {
    std::vector<int> nodes;
    nodes.reserve(static_cast<std::size_t>(N) * elements.size());
    for (const Rule& e : elements) nodes.insert(nodes.end(), e.nodes.begin(), e.nodes.end());
    return nodes;
  }

  /// Positions of the other nodes from the first, one a column: F = edges D, which rounds less far from the
  /// origin. Of a displacement, the change of it.
  Edges edges(std::size_t j, const VecX& q) const {
    const auto& nodes = elements_[j].nodes;
    Edges x;
    for (std::size_t a = 1; a < nodes.size(); ++a)
      x.col(static_cast<Eigen::Index>(a) - 1) = q.segment<3>(3 * nodes[a]) - q.segment<3>(3 * nodes[0]);
    return x;
  }

  /// Of a tet of a group; what a lane without one does is of no use.
  const Material& material(std::size_t group, std::size_t lane) const {
    return materials_[std::min(TetLanes::kLanes * group + lane, materials_.size() - 1)];
  }

  void set_energies(std::size_t group, const VecX& q, TetLanes::Lane& energies) const {
    TetLanes::Deformation at;
    lanes_.deform(group, q, at);
    const TetLanes::Lane& volumes = lanes_.volumes(group);
    for (std::size_t l = 0; l < TetLanes::kLanes; ++l)
      energies[l] =
          volumes[l] > 0.0 ? volumes[l] * material(group, l).psi(Invariants(at.I_C[l], at.J[l])) : 0.0;
  }

  TetLanes::Derivatives derivatives(std::size_t group, const TetLanes::Deformation& at) const {
    TetLanes::Derivatives d;
    for (std::size_t l = 0; l < TetLanes::kLanes; ++l) {
      const InvariantDerivatives of = material(group, l).derivatives(Invariants(at.I_C[l], at.J[l]));
      d.I[l] = of.I;
      d.J[l] = of.J;
      d.II[l] = of.II;
      d.IJ[l] = of.IJ;
      d.JJ[l] = of.JJ;
    }
    return d;
  }

  /// set(group, deformation, derivatives, values) for the groups of elements [begin, end), each with room for
  /// `size` values an element; `begin` begins a group, and there is room for the whole of the last.
  template <class Set>
  void set_groups(int begin, int end, const VecX& q, std::size_t size, double* values, const Set& set) const {
    for (auto j = static_cast<std::size_t>(begin); j < static_cast<std::size_t>(end);
         j += TetLanes::kLanes, values += TetLanes::kLanes * size) {
      const std::size_t group = j / TetLanes::kLanes;
      TetLanes::Deformation at;
      lanes_.deform(group, q, at);
      set(group, at, derivatives(group, at), values);
    }
  }

  void set_vector(std::size_t j, const VecX& q, double* vectors) const {
    Eigen::Map<Eigen::Matrix<double, 3, N>> g_j(vectors);
    g_j.setZero();
    const Edges x = edges(j, q);
    for (std::size_t p = 0; p < P; ++p) {
      const auto& D = elements_[j].D[p];
      g_j.template rightCols<N - 1>() +=
          elements_[j].volumes[p] * materials_[j].dpsi_dF(x * D) * D.transpose();
    }
    g_j.col(0) = -g_j.template rightCols<N - 1>().rowwise().sum();
  }

  void set_matrix(std::size_t j, const VecX& q, HessianKind kind, double* blocks) const {
    std::fill_n(blocks, kMatrixSize, 0.0);
    const Edges x = edges(j, q);
    for (std::size_t p = 0; p < P; ++p) {
      const auto& D = elements_[j].D[p];
      const double volume = elements_[j].volumes[p];
      const Mat3 F = x * D;
      if constexpr (requires { materials_[j].derivatives(Invariants(F)); }) {
        if (kind == HessianKind::exact) {
          add_invariant_blocks<N>(volume, materials_[j].derivatives(Invariants(F)), F, D, blocks);
          continue;
        }
      }
      const bool exact = kind == HessianKind::exact;
      const Mat9 h = volume * (exact ? materials_[j].d2psi_dF2(F) : materials_[j].projected_d2psi_dF2(F));
      add_inner_blocks<N>(h, D, blocks);
    }
    complete_blocks<N>(blocks);
  }

  template <class Body>
  void for_each_element(Body&& body) const {
    parallel_for(static_cast<int>(elements_.size()), kCheap, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) body(static_cast<std::size_t>(j));
    });
  }

  template <class Body>
  void for_each_group(Body&& body) const {
    constexpr int kGroups = kCheap / static_cast<int>(TetLanes::kLanes);
    parallel_for(static_cast<int>(lanes_.group_count()), kGroups, [&](int begin, int end) {
      for (int group = begin; group < end; ++group) body(static_cast<std::size_t>(group));
    });
  }

  std::vector<int> tets_;  // of the mesh, in the order of the elements here
  std::vector<Rule> elements_;
  TetLanes lanes_;  // the same, where kInLanes
  std::vector<Material> materials_;
  TetGather gather_;
  double stiffness_volume_ = 0.0;  // Σ vol_j · stiffness [J]
};

}  // namespace lagomorph::sim
