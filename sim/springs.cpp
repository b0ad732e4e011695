#include "sim/springs.h"

#include <algorithm>
#include <cmath>

#include "sim/compensated_sum.h"
#include "sim/error.h"
#include "sim/pins.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

/// From the point to the vertex.
Vec3 reach(const Springs::Spring& s, const VecX& q) { return q.segment<3>(3 * s.vertex) - s.to; }

}  // namespace

double Springs::value(const VecX& q) const {
  CompensatedSum sum;
  for (const Spring& s : springs_) {
    const double stretch = reach(s, q).norm() - s.rest_length;
    sum.add(0.5 * s.stiffness * stretch * stretch);
  }
  return sum.value();
}

/// The coordinates cancel in the reach.
double Springs::value_scale(const VecX& q) const {
  double scale = 0.0;
  for (const Spring& s : springs_) {
    const double size = q.segment<3>(3 * s.vertex).norm() + s.to.norm() + s.rest_length;
    scale += s.stiffness * std::abs(reach(s, q).norm() - s.rest_length) * size;
  }
  return scale;
}

/// ∂/∂x = k (1 - L/l) d with d = x - p, l = |d|; none where l is zero, which has no direction.
void Springs::add_gradient(const VecX& q, double scale, VecX& g) const {
  for (const Spring& s : springs_) {
    const Vec3 d = reach(s, q);
    const double l = d.norm();
    const double part = s.rest_length == 0.0 ? 1.0 : l > 0.0 ? 1.0 - s.rest_length / l : 0.0;
    g.segment<3>(3 * s.vertex) += scale * s.stiffness * part * d;
  }
}

/// ∂²/∂x² = k (n nᵀ + (1 - L/l)(I - n nᵀ)) with n = d/l: the second part is negative in a pressed spring, and
/// zero where projected.
void Springs::add_hessian(const VecX& q, double scale, HessianKind kind, BlockHessian& H) const {
  for (const Spring& s : springs_) {
    const Vec3 d = reach(s, q);
    const double l = d.norm();
    Mat3 K = Mat3::Identity();
    if (s.rest_length > 0.0 && l > 0.0) {
      const Mat3 along = d * d.transpose() / (l * l);
      double across = 1.0 - s.rest_length / l;
      if (kind == HessianKind::projected) across = std::max(across, 0.0);
      K = along + across * (Mat3::Identity() - along);
    }
    H.block(H.pattern().find(s.vertex, s.vertex)) += scale * s.stiffness * K;
  }
}

void append_springs(const BodySettings& body, const Points& X, int first_vertex, const std::string& where,
                    std::vector<Springs::Spring>& springs) {
  for (std::size_t i = 0; i < body.spring.size(); ++i) {
    const SpringSettings& s = body.spring[i];
    const std::string place = where + ": spring " + std::to_string(i);
    if (!(s.stiffness > 0.0 && std::isfinite(s.stiffness)))
      throw InputError(place + ": stiffness = " + short_number(s.stiffness) + " must be > 0 N/m");
    if (!(s.rest_length >= 0.0 && std::isfinite(s.rest_length)))
      throw InputError(place + ": rest_length = " + short_number(s.rest_length) + " must be >= 0 m");
    if (s.to && !s.to->allFinite()) throw InputError(place + ": to must be finite");
    for (const int v : select_vertices(X, s, place))
      springs.push_back(
          {first_vertex + v, s.stiffness, s.to ? *s.to : Vec3(X.row(v).transpose()), s.rest_length});
  }
}

}  // namespace lagomorph::sim
