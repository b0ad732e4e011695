// Writes TetGen's tets as Gmsh 2.2 ASCII and checks them: orientation, quality, and that they hold every
// vertex, edge midpoint and centroid of the fine surface. Built and run by make_meshes.sh; no part of the
// program.
//
//   write_msh TETGEN_BASE FINE.obj NAME OUT.msh

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Vec = std::array<double, 3>;
using Tet = std::array<int, 4>;

Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// 6 times the signed volume of a tet.
double det(const Vec& a, const Vec& b, const Vec& c, const Vec& d) { return dot(b - a, cross(c - a, d - a)); }

struct Tets {
  std::vector<Vec> X;
  std::vector<Tet> tets;

  std::array<Vec, 4> corners(size_t t) const {
    return {X[tets[t][0]], X[tets[t][1]], X[tets[t][2]], X[tets[t][3]]};
  }
};

/// Rows of a TetGen file: `number` columns after each row's index. TetGen counts from 0 or 1; `first` tells.
template <typename Row>
std::vector<Row> read_rows(const std::string& path, int& first) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  std::vector<Row> rows(std::stoul(line));
  for (size_t i = 0; i < rows.size(); ++i) {
    int index;
    in >> index;
    if (i == 0) first = index;
    for (auto& value : rows[i]) in >> value;
    std::getline(in, line);
  }
  if (!in) throw std::runtime_error("cannot read " + path);
  return rows;
}

Tets read_tetgen(const std::string& base) {
  Tets mesh;
  int first = 0;
  mesh.tets = read_rows<Tet>(base + ".ele", first);
  mesh.X = read_rows<Vec>(base + ".node", first);
  // Nine decimals are what the file will hold; check what is written.
  for (Vec& x : mesh.X) {
    for (double& value : x) value = std::round(value * 1e9) / 1e9;
  }
  for (Tet& tet : mesh.tets) {
    for (int& v : tet) v -= first;
  }
  for (size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto x = mesh.corners(t);
    if (det(x[0], x[1], x[2], x[3]) < 0.0) std::swap(mesh.tets[t][2], mesh.tets[t][3]);
  }
  return mesh;
}

/// Vertices, then edge midpoints and centroids of each triangle of an OBJ file; `vertices` is how many are
/// vertices.
std::vector<Vec> read_samples(const std::string& path, size_t& vertices) {
  std::ifstream in(path);
  std::string line, key, corner;
  std::vector<Vec> x;
  std::vector<std::array<size_t, 3>> triangles;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    row >> key;
    if (key == "v") {
      Vec& p = x.emplace_back();
      row >> p[0] >> p[1] >> p[2];
    } else if (key == "f") {
      for (size_t& v : triangles.emplace_back()) {
        row >> corner;
        v = std::stoul(corner) - 1;
      }
    }
  }
  if (x.empty()) throw std::runtime_error("cannot read " + path);
  vertices = x.size();
  const auto add_mean = [&](std::initializer_list<size_t> corners) {
    Vec mean = {0, 0, 0};
    for (const size_t v : corners) {
      for (int k = 0; k < 3; ++k) mean[k] += x[v][k] / static_cast<double>(corners.size());
    }
    x.push_back(mean);
  };
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) add_mean({t[k], t[(k + 1) % 3]});
    add_mean({t[0], t[1], t[2]});
  }
  return x;
}

/// The largest over all tets of the smallest barycentric coordinate of each point: negative is outside of
/// all.
std::vector<double> depths(const Tets& mesh, const std::vector<Vec>& points) {
  constexpr int n = 48;  // a grid of buckets of points
  Vec low = points[0], high = points[0];
  for (const Vec& p : points) {
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  const auto cell = [&](double value, int k) {
    return std::clamp(static_cast<int>((value - low[k]) / (high[k] - low[k]) * n), 0, n - 1);
  };
  std::vector<std::vector<size_t>> buckets(n * n * n);
  for (size_t i = 0; i < points.size(); ++i) {
    buckets[(cell(points[i][0], 0) * n + cell(points[i][1], 1)) * n + cell(points[i][2], 2)].push_back(i);
  }
  std::vector<double> depth(points.size(), -1.0);
  for (size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto x = mesh.corners(t);
    const double whole = det(x[0], x[1], x[2], x[3]);
    std::array<int, 3> from, to;
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax({x[0][k], x[1][k], x[2][k], x[3][k]});
      from[k] = cell(a, k);
      to[k] = cell(b, k);
    }
    for (int i = from[0]; i <= to[0]; ++i) {
      for (int j = from[1]; j <= to[1]; ++j) {
        for (int k = from[2]; k <= to[2]; ++k) {
          for (const size_t p : buckets[(i * n + j) * n + k]) {
            const Vec& q = points[p];
            depth[p] = std::max(depth[p], std::min({det(q, x[1], x[2], x[3]), det(x[0], q, x[2], x[3]),
                                                    det(x[0], x[1], q, x[3]), det(x[0], x[1], x[2], q)}) /
                                              whole);
          }
        }
      }
    }
  }
  return depth;
}

void print_quality(const Tets& mesh) {
  constexpr int edges[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                               {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  double least = 180, most = 0, volume = 0, smallest = 1e300, largest = 0;
  for (size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto x = mesh.corners(t);
    const double v = det(x[0], x[1], x[2], x[3]) / 6;
    volume += v;
    smallest = std::min(smallest, v);
    largest = std::max(largest, v);
    for (const auto& e : edges) {
      const Vec axis = x[e[1]] - x[e[0]];
      const Vec a = cross(axis, x[e[2]] - x[e[0]]), b = cross(axis, x[e[3]] - x[e[0]]);
      const Vec c = cross(a, b);
      const double angle = std::atan2(std::sqrt(dot(c, c)), dot(a, b)) * 180 / M_PI;
      least = std::min(least, angle);
      most = std::max(most, angle);
    }
  }
  if (!(smallest > 0)) throw std::runtime_error("a tet is flat or inverted");
  std::printf(
      "tets: %zu vertices, %zu tets, dihedral angles %.1f to %.1f degrees, volume %.6f m^3, smallest over "
      "largest %.2e\n",
      mesh.X.size(), mesh.tets.size(), least, most, volume, smallest / largest);
}

void check_enclosed(const Tets& mesh, const std::string& surface) {
  size_t vertices = 0;
  const auto points = read_samples(surface, vertices);
  const auto depth = depths(mesh, points);
  const auto outside = std::count_if(depth.begin(), depth.end(), [](double d) { return d < 0; });
  if (outside > 0)
    throw std::runtime_error(std::to_string(outside) + " points of the surface are outside of the tets");
  std::printf(
      "enclosure: all %zu vertices and %zu edge midpoints and centroids of the surface lie in a tet\n",
      vertices, points.size() - vertices);
}

void write(const Tets& mesh, const std::string& name, const char* path) {
  std::FILE* file = std::fopen(path, "w");
  if (!file) throw std::runtime_error(std::string("cannot write ") + path);
  std::fprintf(file,
               "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"%s\"\n$EndPhysicalNames\n",
               name.c_str());
  std::fprintf(file, "$Nodes\n%zu\n", mesh.X.size());
  for (size_t i = 0; i < mesh.X.size(); ++i) {
    std::fprintf(file, "%zu %.10g %.10g %.10g\n", i + 1, mesh.X[i][0], mesh.X[i][1], mesh.X[i][2]);
  }
  std::fprintf(file, "$EndNodes\n$Elements\n%zu\n", mesh.tets.size());
  for (size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    std::fprintf(file, "%zu 4 2 1 1 %d %d %d %d\n", i + 1, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  }
  std::fprintf(file, "$EndElements\n");
  if (std::fclose(file) != 0) throw std::runtime_error(std::string("cannot write ") + path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: write_msh TETGEN_BASE FINE.obj NAME OUT.msh\n";
    return 2;
  }
  try {
    const Tets mesh = read_tetgen(argv[1]);
    print_quality(mesh);
    check_enclosed(mesh, argv[2]);
    write(mesh, argv[3], argv[4]);
  } catch (const std::exception& error) {
    std::cerr << "write_msh: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
