#include "sim/pin_motion.h"

#include <cmath>
#include <numbers>

#include "sim/error.h"
#include "sim/placement.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

/// translate, rotate, scale of a key.
VecX channels_of(const PinKey& key) {
  VecX c(7);
  c << key.translate, key.rotate, key.scale;
  return c;
}

void check(const PinKey& key, const std::string& where) {
  if (!(key.time >= 0.0 && std::isfinite(key.time)))
    throw InputError(where + ": time = " + short_number(key.time) + " must be >= 0");
  if (!(key.scale > 0.0 && std::isfinite(key.scale)))
    throw InputError(where + ": scale = " + short_number(key.scale) + " must be > 0");
  if (!key.translate.allFinite() || !key.rotate.allFinite())
    throw InputError(where + ": translate and rotate must be finite");
}

/// Keys begin with the rest position at t = 0 where the first is later.
MotionCurve curve_of(const std::vector<PinKey>& keys, bool is_smooth, const std::string& where) {
  std::vector<double> times;
  std::vector<PinKey> all;
  if (keys.front().time > 0.0) all.emplace_back();
  all.insert(all.end(), keys.begin(), keys.end());
  Eigen::MatrixXd samples(7, static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string place = where + ": key " + std::to_string(i + keys.size() - all.size());
    check(all[i], place);
    if (i > 0 && !(all[i].time > times.back()))
      throw InputError(place + ": time = " + short_number(all[i].time) + " must be later than the " +
                       short_number(times.back()) + " before it");
    times.push_back(all[i].time);
    samples.col(static_cast<Eigen::Index>(i)) = channels_of(all[i]);
  }
  return {std::move(times), std::move(samples), is_smooth, MotionCurve::Ends::at_rest};
}

MotionCurve curve_of(const Recording& path, double fps, bool is_smooth) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(path.samples));
  for (int k = 0; k < path.samples; ++k) times.push_back(k / fps);
  const Eigen::Index size = static_cast<Eigen::Index>(path.values.size()) / path.samples;
  return {std::move(times), Eigen::Map<const Eigen::MatrixXd>(path.values.data(), size, path.samples),
          is_smooth, MotionCurve::Ends::by_secant};
}

MotionCurve curve_of(const PinSettings& pin, const Recording& path, Eigen::Index vertices,
                     const std::string& where) {
  const bool is_smooth = pin.interpolation == "smooth";
  if (!is_smooth && pin.interpolation != "linear")
    throw InputError(where + ": unknown interpolation '" + pin.interpolation +
                     "'; valid ones are smooth, linear");
  if (path.samples == 0) return curve_of(pin.key, is_smooth, where);
  if (!pin.key.empty()) throw InputError(where + ": has both keys and a path; give one of them");
  if (!(pin.path_fps.value_or(0.0) > 0.0)) throw InputError(where + ": path_fps must be > 0");
  if (path.vertices != 0 && path.vertices != vertices)
    throw InputError(where + ": its path is of " + std::to_string(path.vertices) +
                     " vertices; the pin holds " + std::to_string(vertices));
  return curve_of(path, *pin.path_fps, is_smooth);
}

Mat3 cross_matrix(const Vec3& w) {
  Mat3 W;
  W << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return W;
}

/// d/dt of R = Rz Ry Rx: ω× R, with ω the sum of each axis's rate as the later rotations turn it.
Mat3 rotation_rate(const Vec3& degrees, const Vec3& degrees_rate) {
  const Vec3 rate = degrees_rate * (std::numbers::pi / 180.0);
  const Mat3 Rz = rotation_of({0, 0, degrees.z()}), Ry = rotation_of({0, degrees.y(), 0});
  const Vec3 omega =
      rate.z() * Vec3::UnitZ() + rate.y() * Rz * Vec3::UnitY() + rate.x() * Rz * Ry * Vec3::UnitX();
  return cross_matrix(omega) * rotation_of(degrees);
}

}  // namespace

PinMotion::PinMotion(const PinSettings& pin, const Recording& path, const Points& X, const std::string& where)
    : kind_(path.samples == 0    ? Kind::keys
            : path.vertices == 0 ? Kind::displacement
                                 : Kind::positions),
      X_(X),
      center_(pin.center ? *pin.center : Vec3(X.colwise().mean().transpose())),
      curve_(curve_of(pin, path, X.rows(), where)) {}

Points PinMotion::positions(double t) const {
  const VecX c = curve_.at(t);
  if (kind_ == Kind::positions) return as_points(c);
  Points x = X_.rowwise() + c.head<3>().transpose();
  if (kind_ == Kind::keys) {  // as a difference, so that a key that changes nothing does not move by rounding
    const Mat3 change = c[6] * rotation_of(c.segment<3>(3)) - Mat3::Identity();
    x += (X_.rowwise() - center_.transpose()) * change.transpose();
  }
  return x;
}

Points PinMotion::velocities(double t) const {
  const VecX rate = curve_.rate(t);
  if (kind_ == Kind::positions) return as_points(rate);
  Points v = rate.head<3>().transpose().replicate(X_.rows(), 1);
  if (kind_ == Kind::keys) {
    const VecX c = curve_.at(t);
    const Mat3 change =
        rate[6] * rotation_of(c.segment<3>(3)) + c[6] * rotation_rate(c.segment<3>(3), rate.segment<3>(3));
    v += (X_.rowwise() - center_.transpose()) * change.transpose();
  }
  return v;
}

}  // namespace lagomorph::sim
