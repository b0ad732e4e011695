#include "apps/calibrate/faults.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace {

using render::Picture;
using render::Vec3;

template <class Change>
Picture changed(const Picture& picture, const Change& change) {
  Picture result = picture;
  for (std::size_t i = 0; i < result.rgb.size(); ++i) {
    const double value = change(static_cast<double>(picture.rgb[i]), i);
    result.rgb[i] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  }
  return result;
}

/// +1, 0 or -1 by the bits of Knuth's multiplicative hash.
Picture rounded(const Picture& picture) {
  return changed(picture, [](double v, std::size_t i) {
    return v + static_cast<double>((static_cast<std::uint32_t>(i) * 2654435761U >> 16) % 3) - 1.0;
  });
}

/// To the right; the left border repeats.
Picture shifted(const Picture& picture) {
  Picture result = picture;
  const std::ptrdiff_t row = std::ptrdiff_t{3} * picture.width;
  for (int y = 0; y < picture.height; ++y) {
    const auto from = picture.rgb.begin() + y * row;
    std::copy(from, from + row - 3, result.rgb.begin() + y * row + 3);
  }
  return result;
}

Picture cast(const Picture& picture) {
  return changed(picture, [](double v, std::size_t i) { return i % 3 == 0 ? 1.1 * v : v; });
}

Picture gamma(const Picture& picture) {
  return changed(picture, [](double v, std::size_t) { return 255.0 * std::pow(v / 255.0, 1.1); });
}

bool is_within(const Cluster& cluster, const Vec3& p) { return (p - cluster.center).norm() < cluster.radius; }

float diagonal(const render::Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Vec3& p : mesh.positions) box.extend(p);
  return box.diagonal().norm();
}

}  // namespace

const std::vector<PictureChange>& picture_changes() {
  static const std::vector<PictureChange> all = {{"1 of 255", true, rounded},
                                                 {"1 pixel", false, shifted},
                                                 {"cast", false, cast},
                                                 {"gamma 1.1", false, gamma}};
  return all;
}

Cluster visible_cluster(const std::vector<render::Mesh>& meshes, const render::Camera& camera, int frame) {
  Cluster cluster;
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const Vec3& p : meshes[m].positions) {
      const float depth = camera.depth(p);
      if (depth <= 0 || depth >= nearest) continue;
      const render::Vec2 at = camera.project(p);
      const float w = static_cast<float>(camera.width()), h = static_cast<float>(camera.height());
      const bool inside = at.x() > 0.1F * w && at.x() < 0.9F * w && at.y() > 0.1F * h && at.y() < 0.9F * h;
      if (!inside) continue;
      nearest = depth;
      cluster = {m, p, 0};
    }
  }
  if (std::isinf(nearest)) {
    wrong_input(
        fmt::format("no body is in the picture of frame {}: there is nothing to remove or move "
                    "for a fault",
                    frame));
  }
  cluster.radius = diagonal(meshes[cluster.mesh]) / 8;
  return cluster;
}

void remove_cluster(render::Mesh& mesh, const Cluster& cluster) {
  std::erase_if(mesh.triangles, [&](const render::Triangle& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return is_within(cluster, mesh.positions[v]); });
  });
}

void move_cluster(render::Mesh& mesh, const Cluster& cluster, const render::Camera& camera) {
  for (Vec3& p : mesh.positions) {
    if (!is_within(cluster, p)) continue;
    const float off = (p - cluster.center).norm() / cluster.radius;
    const float weight = (1 - off * off) * (1 - off * off);
    p += 0.5F * cluster.radius * weight * camera.right();
  }
}

}  // namespace lagomorph::apps
