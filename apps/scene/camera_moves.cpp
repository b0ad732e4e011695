#include "apps/scene/camera_moves.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lagomorph::apps {
namespace {

using sim::Vec3;
constexpr double pi = std::numbers::pi;

struct ViewRow {
  const char* name;
  Vec3 from;  // towards the eye, of any length
  Vec3 up;
};
const std::vector<ViewRow>& view_rows() {
  static const std::vector<ViewRow> rows = {
      {"front", {0, 0, 1}, {0, 1, 0}},    {"back", {0, 0, -1}, {0, 1, 0}}, {"left", {-1, 0, 0}, {0, 1, 0}},
      {"right", {1, 0, 0}, {0, 1, 0}},    {"top", {0, 1, 0}, {0, 0, -1}},  {"bottom", {0, -1, 0}, {0, 0, 1}},
      {"isometric", {1, 1, 1}, {0, 1, 0}}};
  return rows;
}

/// From a side, as far from look_at as before.
void look_from(render::CameraSettings& c, const std::string& view) {
  const auto row =
      std::find_if(view_rows().begin(), view_rows().end(), [&](const ViewRow& r) { return view == r.name; });
  if (row == view_rows().end()) return;
  const double distance = (c.position - c.look_at).cast<double>().norm();
  c.position = (c.look_at.cast<double>() + distance * row->from.normalized()).cast<float>();
  c.up = row->up.cast<float>();
}

/// About +y through look_at, counterclockwise from above. [rad]
void turn(render::CameraSettings& c, double angle) {
  const Eigen::Matrix3d about_y = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
  const Vec3 look_at = c.look_at.cast<double>();
  c.position = (look_at + about_y * (c.position.cast<double>() - look_at)).cast<float>();
  c.up = (about_y * c.up.cast<double>()).cast<float>();
}

/// Half the height of the view at distance 1 is divided by it, or that of an orthographic one.
void magnify(render::CameraSettings& c, double zoom) {
  if (c.orthographic) c.orthographic = static_cast<float>(*c.orthographic / zoom);
  c.fov = static_cast<float>(std::atan(std::tan(c.fov * pi / 360.0) / zoom) * 360.0 / pi);
}

/// What must be in the picture, from the middle of the box: its corners, or what they sweep on a turntable.
std::vector<Vec3> outline(const Eigen::AlignedBox3d& box, bool turns) {
  constexpr int around = 64;
  const Vec3 half = 0.5 * box.diagonal();
  std::vector<Vec3> points;
  if (turns) {
    const double radius = std::hypot(half.x(), half.z());
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * pi * i / around;
      for (const double y : {-half.y(), half.y()})
        points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
    return points;
  }
  for (int i = 0; i < 8; ++i)
    points.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                        (i & 4) != 0 ? half.z() : -half.z());
  return points;
}

/// A key's own value, or nothing.
std::optional<sim::VecX> values_of(const std::optional<Vec3>& v) {
  return v ? std::optional<sim::VecX>(*v) : std::nullopt;
}
std::optional<sim::VecX> values_of(const std::optional<float>& v) {
  return v ? std::optional<sim::VecX>(sim::VecX::Constant(1, static_cast<double>(*v))) : std::nullopt;
}

render::Vec3 vector_of(const sim::VecX& v) { return Vec3(v).cast<float>(); }
float number_of(const sim::VecX& v) { return static_cast<float>(v[0]); }

}  // namespace

std::vector<std::string> camera_views() {
  std::vector<std::string> names = {"none"};
  for (const ViewRow& row : view_rows()) names.emplace_back(row.name);
  return names;
}

std::vector<std::string> camera_frames() { return {"none", "center", "rest", "motion"}; }

std::optional<sim::VecX> CameraMoves::Track::at(double t) const {
  return curve ? std::optional<sim::VecX>(curve->at(t)) : std::nullopt;
}

CameraMoves::Track CameraMoves::track_of(int size, const auto& value) const {
  std::vector<double> times;
  std::vector<sim::VecX> samples;
  for (const CameraKey& key : camera_.key) {
    if (const std::optional<sim::VecX> v = values_of(value(key))) {
      times.push_back(key.time ? *key.time : *key.frame / fps_);
      samples.push_back(*v);
    }
  }
  if (times.empty()) return {};
  Eigen::MatrixXd columns(size, static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = samples[i];
  return {sim::MotionCurve(std::move(times), std::move(columns), camera_.interpolation == "smooth",
                           sim::MotionCurve::Ends::at_rest)};
}

CameraMoves::CameraMoves(const CameraDesc& camera, const sim::TimeSettings& time, double aspect)
    : camera_(camera), fps_(time.fps), frames_(time.frames), aspect_(aspect) {
  position_ = track_of(3, [](const CameraKey& k) { return k.position; });
  look_at_ = track_of(3, [](const CameraKey& k) { return k.look_at; });
  up_ = track_of(3, [](const CameraKey& k) { return k.up; });
  fov_ = track_of(1, [](const CameraKey& k) { return k.fov; });
  orthographic_ = track_of(1, [](const CameraKey& k) { return k.orthographic; });
  zoom_ = track_of(1, [](const CameraKey& k) { return k.zoom; });
  focus_distance_ = track_of(1, [](const CameraKey& k) { return k.focus_distance; });
  f_stop_ = track_of(1, [](const CameraKey& k) { return k.f_stop; });
}

/// [rad]
double CameraMoves::turn_at(double frame) const {
  const TurntableDesc& t = camera_.turntable;
  double turns = t.start / 360.0;
  if (t.turns) turns += *t.turns * frame / frames_;
  if (t.period) turns += frame / fps_ / *t.period;
  return 2.0 * pi * turns;
}

/// Looks at the middle of the box, from as far as its outline is inside the picture but for the margins and
/// the strip: a point at (x, y) across and z along the view from the middle is, at a distance d, where |y| <=
/// height (d + z) and, of a camera that is moved by s to its right,
///   -left (d + z) <= x - s <= right (d + z).
/// Without a strip s is 0. Some s does for all points where d (left + right) >= max(x - right z) + max(-x -
/// left z). That s, the nearest to where the middle of the box is in the middle of what is free. [m]
double CameraMoves::fit(render::CameraSettings& c, const Eigen::AlignedBox3d& box, double strip) const {
  const Vec3 middle = box.center();
  if (camera_.frame == "center") {
    c.look_at = middle.cast<float>();
    return 0.0;
  }
  const Vec3 forward = (c.look_at - c.position).cast<double>().normalized();
  const Vec3 right = forward.cross(c.up.cast<double>()).normalized(), up = right.cross(forward);
  const double inside = 1.0 - 2.0 * static_cast<double>(camera_.margin);
  const double kept = std::min({strip, 0.5, 0.75 * inside});
  const double half_height = std::tan(static_cast<double>(c.fov) * pi / 360.0),
               half_width = aspect_ * half_height;
  const double to_left = half_width * inside, to_right = half_width * (inside - 2.0 * kept);
  constexpr double least = 1e-3;  // of a body that is a point [m]
  const std::vector<Vec3> points = outline(box, camera_.turntable.turns || camera_.turntable.period);
  double distance = least, height = least, reach_right = 0.0, reach_left = 0.0;
  for (const Vec3& p : points) {
    const double x = p.dot(right), y = std::abs(p.dot(up)), z = p.dot(forward);
    distance = std::max(distance, c.orthographic ? 2.0 * p.norm() - z : y / (half_height * inside) - z);
    height = std::max({height, 2.0 * y / inside, 2.0 * std::abs(x) / (aspect_ * (inside - kept))});
    reach_right = std::max(reach_right, x - to_right * z);
    reach_left = std::max(reach_left, -x - to_left * z);
  }
  const double across = strip == 0.0 ? std::max(reach_right, reach_left) / to_right
                                     : (reach_right + reach_left) / (to_left + to_right);
  if (!c.orthographic) distance = std::max(distance, across);
  if (c.orthographic) c.orthographic = static_cast<float>(height);
  c.look_at = middle.cast<float>();
  c.position = (middle - distance * forward).cast<float>();
  if (strip == 0.0) return 0.0;
  if (c.orthographic) return 0.5 * kept * aspect_ * height;
  // The strip is 2 kept of the view's half widths: its middle is kept of one to the left of the picture's.
  return std::clamp(kept * half_width * distance, reach_right - to_right * distance,
                    std::max(reach_right - to_right * distance, to_left * distance - reach_left));
}

render::CameraSettings CameraMoves::at(double frame, const std::optional<Eigen::AlignedBox3d>& box,
                                       double strip) const {
  render::CameraSettings c = camera_;
  const double t = frame / fps_;
  if (const auto v = position_.at(t)) c.position = vector_of(*v);
  if (const auto v = look_at_.at(t)) c.look_at = vector_of(*v);
  if (const auto v = up_.at(t)) c.up = vector_of(*v);
  if (const auto v = fov_.at(t)) c.fov = number_of(*v);
  if (const auto v = orthographic_.at(t)) c.orthographic = number_of(*v);
  if (const auto v = focus_distance_.at(t)) c.focus_distance = number_of(*v);
  if (const auto v = f_stop_.at(t)) c.f_stop = number_of(*v);
  look_from(c, camera_.view);
  double aside = 0.0;  // to the right, for the strip [m]
  if (camera_.frame != "none" && box && !box->isEmpty()) aside = fit(c, *box, strip);
  if (const double angle = turn_at(frame); angle != 0.0) turn(c, angle);
  const auto keyed = zoom_.at(t);
  const float zoom = keyed ? number_of(*keyed) : camera_.zoom;
  if (zoom != 1.0F) magnify(c, static_cast<double>(zoom));
  if (aside != 0.0) {
    const Vec3 right = (c.look_at - c.position).cross(c.up).cast<double>().normalized();
    shift(c, aside / static_cast<double>(zoom) * right);
  }
  return c;
}

void shift(render::CameraSettings& c, const Vec3& offset) {
  if (offset.isZero(0.0)) return;
  c.position = (c.position.cast<double>() + offset).cast<float>();
  c.look_at = (c.look_at.cast<double>() + offset).cast<float>();
}

bool depends_on_frame_count(const SceneDesc& scene) {
  return scene.camera.turntable.turns || scene.caption.text.find("{frames") != std::string::npos;
}

}  // namespace lagomorph::apps
