#include "apps/pipeline/glyphs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "apps/overlay/arrows.h"
#include "apps/overlay/overlay.h"
#include "apps/overlay/stroke_font.h"
#include "apps/pipeline/build_scene.h"

namespace lagomorph::apps {
namespace {

using render::Vec3;
using sim::VecX;

constexpr Color gravity_color = {120, 190, 255};

sim::Vec3 force_on(const VecX& f, int node) { return f.segment<3>(3 * static_cast<Eigen::Index>(node)); }

/// The force on a body, its centre by the forces' sizes, and where the surface looks there: 0 where it looks
/// everywhere, as that of a body whose inside is pulled.
struct Total {
  sim::Vec3 force = sim::Vec3::Zero(), center = sim::Vec3::Zero(), normal = sim::Vec3::Zero();
};
constexpr double of_one_side = 0.3;  // least part of normals that do not cancel

/// Outward, by the areas around; zero of nodes inside. Of all nodes of the mesh.
std::vector<Vec3> node_normals(const LineMesh& mesh, const std::vector<Vec3>& x) {
  std::vector<Vec3> normals(x.size(), Vec3::Zero());
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 n = (x[j] - x[i]).cross(x[k] - x[i]);
    for (const std::uint32_t node : {i, j, k}) normals[node] += n;
  }
  return normals;
}

Total total_of(const sim::Body& body, const VecX& f, const std::vector<Vec3>& x,
               const std::vector<Vec3>& normals) {
  Total total;
  double weights = 0.0, normals_apart = 0.0;
  for (int v = body.vertices.begin; v < body.vertices.end; ++v) {
    const double weight = force_on(f, v).norm();
    total.force += force_on(f, v);
    total.center += weight * x[static_cast<std::size_t>(v)].cast<double>();
    const sim::Vec3 normal = weight * normals[static_cast<std::size_t>(v)].cast<double>();
    total.normal += normal;
    normals_apart += normal.norm();
    weights += weight;
  }
  if (weights > 0.0) total.center /= weights;
  if (total.normal.norm() < of_one_side * normals_apart) total.normal.setZero();
  return total;
}

/// The largest of an arrow's force at all times: loads are linear in time between the points of their curves,
/// so that it is at one of these.
double largest_force(const SceneDesc& scene, const sim::Model& model) {
  std::set<double> times = {0.0};
  for (const BodyDesc& body : scene.body)
    for (const sim::LoadSettings& load : body.physics.load)
      for (const auto& point : load.curve) times.insert(point[0]);
  double most = 0.0;
  for (const double t : times) {
    const VecX f = model.load_force(t);
    if (f.size() == 0) continue;
    for (const sim::Body& body : model.mesh().bodies) {
      sim::Vec3 sum = sim::Vec3::Zero();
      for (int v = body.vertices.begin; v < body.vertices.end; ++v) {
        sum += force_on(f, v);
        if (scene.glyphs.loads == "vertices") most = std::max(most, force_on(f, v).norm());
      }
      if (scene.glyphs.loads == "total") most = std::max(most, sum.norm());
    }
  }
  return most;
}

std::string force_text(double newtons) {
  if (newtons >= 1e6) return fmt::format("{:.3g} MN", newtons / 1e6);
  if (newtons >= 1e3) return fmt::format("{:.3g} kN", newtons / 1e3);
  if (newtons < 0.1) return fmt::format("{:.3g} mN", newtons * 1e3);
  return fmt::format("{:.3g} N", newtons);
}

/// On a plate of its own beyond the free end of an arrow.
void draw_tag(render::Picture& picture, const render::Camera& camera, const Vec3& from, const Vec3& free_end,
              const std::string& text, const Color& color) {
  const ViewPoint a = view_point(camera, from), b = view_point(camera, free_end);
  if (a.depth < near_depth || b.depth < near_depth) return;
  const double height = overlay_text_height(picture), width = text_width(text, height), pad = 0.6 * height;
  const double length = std::max(1.0, std::hypot(b.x - a.x, b.y - a.y));
  const Point along{(b.x - a.x) / length, (b.y - a.y) / length};
  const double half_width = 0.5 * width + pad, half_height = 0.5 * height + pad;
  const double away = 0.5 * height + std::abs(along.x) * half_width + std::abs(along.y) * half_height;
  // Within the picture, while the arrow's end is.
  if (b.x < 0.0 || b.y < 0.0 || b.x > picture.width || b.y > picture.height) return;
  const double x = std::clamp(std::round(b.x + away * along.x), std::min(half_width, 0.5 * picture.width),
                              std::max(picture.width - half_width, 0.5 * picture.width));
  const double y = std::clamp(std::round(b.y + away * along.y), std::min(half_height, 0.5 * picture.height),
                              std::max(picture.height - half_height, 0.5 * picture.height));
  draw_plate(picture, {x - half_width, y - half_height, x + half_width, y + half_height});
  draw_text(picture, x - 0.5 * width, y + 0.5 * height, text, {.height = height, .color = color});
}

Color lighter(const Color& color) {
  Color all;
  for (std::size_t i = 0; i < 3; ++i) all[i] = static_cast<std::uint8_t>(color[i] + (255 - color[i]) * 3 / 5);
  return all;
}

}  // namespace

Glyphs::Glyphs(const SceneDesc& scene, const sim::Model& model, const std::vector<sim::Surface>& surfaces)
    : scene_(scene), model_(model), surfaces_(surfaces) {
  if (is_empty()) return;
  const sim::Points& X = model.mesh().X;
  // Of the smallest body, on which they must be readable, too.
  double diagonal = std::numeric_limits<double>::infinity();
  for (const sim::Body& body : model.mesh().bodies) {
    const auto own = X.middleRows(body.vertices.begin, body.vertices.size());
    diagonal = std::min(diagonal, (own.colwise().maxCoeff() - own.colwise().minCoeff()).norm());
  }
  size_ = scene.glyphs.size.value_or(diagonal / 55.0);
  const double largest = scene.glyphs.loads == "none" ? 0.0 : largest_force(scene, model);
  force_ = scene.glyphs.force.value_or(largest > 0.0 ? largest / (0.22 * diagonal) : 1.0);
  for (std::size_t b = 0; b < scene.body.size(); ++b) {
    tets_.push_back(lines_of_tets(scene, model, b));
    skin_.emplace_back(static_cast<std::size_t>(X.rows()));
    for (const render::Triangle& t : tets_.back().mesh.triangles)
      for (const std::uint32_t node : t) skin_.back()[node] = true;
  }
}

bool Glyphs::is_empty() const {
  const GlyphsDesc& g = scene_.glyphs;
  return !g.pins && g.loads == "none" && !g.gravity && g.displacement_every == 0;
}

bool Glyphs::sees_vertex(const View& view, std::size_t body, std::uint32_t node,
                         const std::vector<Vec3>& positions) const {
  return view.sees(positions[node], triangles_with(tets_[body].mesh, node, own_items(body)));
}

void Glyphs::draw_pins(render::Picture& picture, const View& view, const sim::State& state) const {
  const std::vector<Vec3> x = to_render(sim::as_points(state.q));
  const sim::Pins& pins = model_.held(state.t).pins();
  std::vector<Dot> dots;
  for (const int v : pins.vertices()) {
    for (std::size_t b = 0; b < tets_.size(); ++b) {
      const auto node = static_cast<std::uint32_t>(v);
      if (!skin_[b][node]) continue;
      dots.push_back({.at = x[node],
                      .color = srgb_color(scene_.glyphs.pin_color),
                      .diameter = size_,
                      .hollow = !pins.is_pinned(v),
                      .visible = sees_vertex(view, b, node, x)});
    }
  }
  draw_dots(picture, view.camera(), std::move(dots));
}

/// From the surface where a force pulls, onto it where it pushes.
void Glyphs::draw_loads(render::Picture& picture, const View& view, const sim::State& state) const {
  const VecX f = model_.load_force(state.t);
  if (f.size() == 0) return;
  const std::vector<Vec3> x = to_render(sim::as_points(state.q));
  const Color color = srgb_color(scene_.glyphs.load_color);
  const bool in_all = scene_.glyphs.loads == "total";
  std::vector<Arrow> arrows, inner;  // on surfaces; from within, so that nothing hides them
  const auto add = [&](const sim::Vec3& at, const sim::Vec3& force, const sim::Vec3& normal) {
    const sim::Vec3 length = force / force_;
    if (length.norm() < 1e-3 * size_) return;
    const bool pushes = force.dot(normal) < 0.0;
    if (in_all) {
      const sim::Vec3 end = pushes ? sim::Vec3(at - length) : sim::Vec3(at + length);
      draw_tag(picture, view.camera(), at.cast<float>(), end.cast<float>(), force_text(force.norm()),
               lighter(color));
    }
    const sim::Vec3 tail = pushes ? sim::Vec3(at - length) : at;
    std::vector<Arrow>& kind = in_all && normal.isZero(0.0) ? inner : arrows;
    kind.push_back({.from = tail.cast<float>(),
                    .to = (tail + length).cast<float>(),
                    .color = color,
                    .head = in_all ? 2.2 * size_ : size_});
  };
  for (std::size_t b = 0; b < tets_.size(); ++b) {
    const std::vector<Vec3> normals = node_normals(tets_[b].mesh, x);
    const sim::Body& body = model_.mesh().bodies[b];
    if (in_all) {
      const Total total = total_of(body, f, x, normals);
      add(total.center, total.force, total.normal);
      continue;
    }
    for (int v = body.vertices.begin; v < body.vertices.end; ++v) {
      const auto node = static_cast<std::size_t>(v);
      if (skin_[b][node]) add(x[node].cast<double>(), force_on(f, v), normals[node].cast<double>());
    }
  }
  draw_arrows(picture, view, std::move(arrows));
  draw_arrows(picture, view, std::move(inner), false);
}

/// From each body's centre of mass; inside of it, so that nothing hides it.
void Glyphs::draw_gravity(render::Picture& picture, const View& view, const sim::State& state) const {
  const double size = scene_.time.gravity.norm();
  if (size == 0.0) return;
  const VecX masses = model_.mass_times(VecX::Ones(state.q.size()));
  std::vector<Arrow> arrows;
  for (const sim::Body& body : model_.mesh().bodies) {
    sim::Vec3 moment = sim::Vec3::Zero();
    double mass = 0.0;
    for (int v = body.vertices.begin; v < body.vertices.end; ++v) {
      const double m = masses[3 * static_cast<Eigen::Index>(v)];
      moment += m * state.q.segment<3>(3 * static_cast<Eigen::Index>(v));
      mass += m;
    }
    const sim::Vec3 center = moment / mass;
    const sim::Vec3 tip = center + 10.0 * size_ * scene_.time.gravity / size;
    arrows.push_back(
        {.from = center.cast<float>(), .to = tip.cast<float>(), .color = gravity_color, .head = 1.8 * size_});
    draw_dots(picture, view.camera(),
              {{.at = center.cast<float>(), .color = gravity_color, .diameter = size_}});
  }
  draw_arrows(picture, view, arrows, false);
  for (const Arrow& arrow : arrows)
    draw_tag(picture, view.camera(), arrow.from, arrow.to, "g", lighter(gravity_color));
}

void Glyphs::for_displacements(const VecX& q, const auto& visit) const {
  const int every = scene_.glyphs.displacement_every;
  if (every == 0) return;
  const VecX rest = sim::as_q(model_.mesh().X);
  for (const sim::Surface& surface : surfaces_) {
    const sim::Points X = surface.positions(rest), x = surface.positions(q);
    for (Eigen::Index v = 0; v < surface.first_cut_vertex(); v += every)
      visit(sim::Vec3(X.row(v).transpose()), sim::Vec3(x.row(v).transpose()));
  }
}

double Glyphs::largest_displacement(const VecX& q) const {
  double most = 0.0;
  for_displacements(q, [&](const sim::Vec3& X, const sim::Vec3& x) {
    const double length = (x - X).norm();
    if (std::isfinite(length)) most = std::max(most, length);
  });
  return most;
}

void Glyphs::draw_displacements(render::Picture& picture, const View& things, const VecX& q,
                                double most) const {
  const render::Colormap& map = render::find_colormap(scene_.glyphs.colormap);
  std::vector<Arrow> arrows;
  for_displacements(q, [&](const sim::Vec3& X, const sim::Vec3& x) {
    const double length = (x - X).norm();
    if (length < 0.2 * size_) return;
    const auto along = static_cast<float>(most > 0.0 ? length / most : 0.0);
    const std::array<float, 3> rgb = render::srgb_of(map, along);
    Color color;
    for (std::size_t i = 0; i < 3; ++i) color[i] = static_cast<std::uint8_t>(std::lround(255.0F * rgb[i]));
    arrows.push_back({.from = X.cast<float>(), .to = x.cast<float>(), .color = color, .head = size_});
  });
  draw_arrows(picture, things, std::move(arrows));
}

void Glyphs::draw(render::Picture& picture, const View& things, const sim::State& state, double most,
                  const std::function<bool(std::size_t)>& hides) const {
  if (is_empty()) return;
  draw_displacements(picture, things, state.q, most);
  View view = things;
  for (std::size_t b = 0; b < tets_.size(); ++b)
    if (hides(b)) view.items().draw(tets_[b].mesh.triangles, positions_of(tets_[b], state.q), own_items(b));
  if (scene_.glyphs.pins) draw_pins(picture, view, state);
  if (scene_.glyphs.loads != "none") draw_loads(picture, view, state);
  if (scene_.glyphs.gravity) draw_gravity(picture, view, state);
}

}  // namespace lagomorph::apps
