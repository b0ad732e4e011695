#include "sim/block_hessian.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

#include "sim/tet_gather.h"
#include "tests/unit/sim/mesh_fixtures.h"

namespace lagomorph::sim {
namespace block_hessian_test {

std::shared_ptr<const BlockPattern> pattern_of(const TetMesh& mesh) {
  return std::make_shared<const BlockPattern>(mesh.vertex_count(), mesh.tets);
}

std::vector<double> random_values(std::size_t size) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(size);
  for (double& v : values) v = uniform(random);
  return values;
}

TEST(BlockPattern, HasThePairsThatShareATet) {
  const TetMesh mesh = cube_mesh(3);
  const BlockPattern pattern(mesh.vertex_count(), mesh.tets);
  std::set<std::pair<int, int>> expected, actual;
  for (int v = 0; v < mesh.vertex_count(); ++v) expected.emplace(v, v);
  for (const Tet& tet : mesh.tets)
    for (const int i : tet)
      for (const int j : tet)
        if (i <= j) expected.emplace(i, j);
  for (int j = 0; j < pattern.vertex_count(); ++j) {
    for (int k = pattern.starts()[static_cast<std::size_t>(j)];
         k < pattern.starts()[static_cast<std::size_t>(j) + 1]; ++k) {
      actual.emplace(pattern.rows()[static_cast<std::size_t>(k)], j);
      EXPECT_EQ(pattern.find(pattern.rows()[static_cast<std::size_t>(k)], j), k);
    }
  }
  EXPECT_EQ(actual, expected);
  EXPECT_EQ(pattern.block_count(), static_cast<int>(expected.size()));
}

TEST(BlockPattern, GivesAVertexWithoutTetsItsDiagonal) {
  const BlockPattern pattern(3, {});
  EXPECT_EQ(pattern.block_count(), 3);
  EXPECT_EQ(pattern.find(1, 1), 1);
}

/// The oracle: element matrices by triplets, both triangles.
SparseMatrix by_triplets(const TetMesh& mesh, const std::vector<double>& element_matrices) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < mesh.tets.size(); ++j) {
    for (int b = 0; b < 4; ++b) {
      for (int a = 0; a <= b; ++a) {
        const double* block =
            element_matrices.data() + TetGather::matrix_size(4) * j + 9 * TetGather::pair(a, b);
        const int i = mesh.tets[j][static_cast<std::size_t>(a)],
                  k = mesh.tets[j][static_cast<std::size_t>(b)];
        for (int c = 0; c < 3; ++c) {
          for (int r = 0; r < 3; ++r) {
            entries.emplace_back(3 * i + r, 3 * k + c, block[3 * c + r]);
            if (a != b) entries.emplace_back(3 * k + c, 3 * i + r, block[3 * c + r]);
          }
        }
      }
    }
  }
  SparseMatrix H(3 * mesh.vertex_count(), 3 * mesh.vertex_count());
  H.setFromTriplets(entries.begin(), entries.end());
  return H;
}

TetMesh ascending_cube(int n) {
  TetMesh mesh = cube_mesh(n);
  for (Tet& tet : mesh.tets) std::sort(tet.begin(), tet.end());
  return mesh;
}

std::vector<int> nodes_of(const TetMesh& mesh) {
  std::vector<int> nodes;
  for (const Tet& tet : mesh.tets) nodes.insert(nodes.end(), tet.begin(), tet.end());
  return nodes;
}

TEST(TetGather, AddsMatricesAsTripletsDo) {
  const TetMesh mesh = ascending_cube(6);  // of several batches
  const auto pattern = pattern_of(mesh);
  const TetGather gather(nodes_of(mesh), 4, pattern);
  const std::vector<double> matrices = random_values(TetGather::matrix_size(4) * mesh.tets.size());
  const auto fill = [&](int begin, int end, double* batch) {
    const auto size = static_cast<std::ptrdiff_t>(TetGather::matrix_size(4));
    std::copy(matrices.begin() + size * begin, matrices.begin() + size * end, batch);
  };
  BlockHessian H(pattern);
  gather.add_matrices(2.0, H, fill);
  gather.add_matrices(1.0, H, fill);
  const SparseMatrix expected = by_triplets(mesh, matrices);
  EXPECT_LT((H.to_sparse() - 3.0 * expected).norm(), 1e-14 * expected.norm());
  H.set_zero();
  EXPECT_EQ(H.to_sparse().norm(), 0.0);
}

TEST(TetGather, AddsVectorsAsALoopDoes) {
  const TetMesh mesh = ascending_cube(6);  // of several batches
  const TetGather gather(nodes_of(mesh), 4, pattern_of(mesh));
  const std::vector<double> vectors = random_values(TetGather::vector_size(4) * mesh.tets.size());
  VecX g = VecX::Ones(3 * mesh.vertex_count()), expected = g;
  gather.add_vectors(-0.5, g, [&](int begin, int end, double* of_elements) {
    const auto size = static_cast<std::ptrdiff_t>(TetGather::vector_size(4));
    std::copy(vectors.begin() + size * begin, vectors.begin() + size * end, of_elements);
  });
  for (std::size_t j = 0; j < mesh.tets.size(); ++j)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t k = 0; k < 3; ++k)
        expected[3 * mesh.tets[j][a] + static_cast<int>(k)] -= 0.5 * vectors[12 * j + 3 * a + k];
  EXPECT_LT((g - expected).norm(), 1e-14 * expected.norm());
}

/// A symmetric random matrix on the cube's pattern.
BlockHessian random_hessian(const std::shared_ptr<const BlockPattern>& pattern) {
  BlockHessian H(pattern);
  const std::vector<double> values = random_values(9 * static_cast<std::size_t>(pattern->block_count()));
  for (int k = 0; k < pattern->block_count(); ++k)
    H.block(k) = Eigen::Map<const Mat3>(values.data() + 9 * static_cast<std::size_t>(k));
  for (int v = 0; v < pattern->vertex_count(); ++v) {
    const int k = pattern->find(v, v);
    H.block(k) = (H.block(k) + H.block(k).transpose()).eval();
  }
  return H;
}

TEST(BlockHessian, MultipliesAsTheSparseMatrixDoes) {
  const BlockHessian H = random_hessian(pattern_of(cube_mesh(2)));
  const VecX x = Eigen::Map<const VecX>(random_values(81).data(), 81);
  const SparseMatrix full = H.to_sparse();
  EXPECT_EQ(SparseMatrix(full.transpose()).toDense(), full.toDense());
  EXPECT_LT((H.times(x) - full * x).norm(), 1e-14 * x.norm() * full.norm());
}

/// The estimate is what rounding x to fewer digits does, within a factor: here from double to float.
TEST(BlockHessian, EstimatesTheRoundingOfAProduct) {
  const BlockHessian H = random_hessian(pattern_of(cube_mesh(3)));
  const VecX x = Eigen::Map<const VecX>(random_values(192).data(), 192);
  const VecX rounded = x.cast<float>().cast<double>();
  const double float_to_double = std::ldexp(1.0, 29);
  const double actual = (H.times(x) - H.times(rounded)).norm();
  const double estimate = float_to_double * H.rounding_of_times(x).norm();
  EXPECT_LT(actual, estimate);
  EXPECT_GT(actual, 0.2 * estimate);
}

}  // namespace block_hessian_test
}  // namespace lagomorph::sim
