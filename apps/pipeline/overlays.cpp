#include "apps/pipeline/overlays.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/overlay/ghost.h"
#include "apps/overlay/overlay.h"
#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/surface_fields.h"
#include "apps/scene/panels.h"

namespace lagomorph::apps {
namespace {

LineStyle style_of(const WireframeDesc& w) {
  return {.color = srgb_color(w.color), .width = w.width, .opacity = w.opacity, .hidden = w.hidden};
}

GhostStyle style_of(const GhostDesc& g) {
  return {.fill = g.show != "outline",
          .outline = g.show != "fill",
          .color = srgb_color(g.color),
          .opacity = g.opacity,
          .over = g.over};
}

bool has_any(const std::vector<BodyLines>& all) {
  return std::any_of(all.begin(), all.end(), [](const BodyLines& b) { return !b.mesh.edges.empty(); });
}

}  // namespace

Overlays::Overlays(const SceneDesc& scene, const sim::Model& model, const std::vector<sim::Surface>& surfaces)
    : scene_(scene),
      model_(model),
      drawn_(scene.body.size()),
      wireframes_(scene.body.size()),
      ghosts_(scene.body.size()),
      glyphs_(scene, model, surfaces) {
  for (std::size_t i = 0; i < scene.body.size(); ++i) {
    const BodyDesc& body = scene.body[i];
    if (body.wireframe.show) wireframes_[i] = lines_of(scene, model, surfaces, i, body.wireframe.of);
    if (body.ghost.show != "none")  // whole, where the body is cut
      ghosts_[i] = scene.clip ? lines_of_all_tets(model, i) : lines_of_surface(surfaces[i]);
    labels_.emplace_back(scene, model, surfaces, i);
  }
  if (!has_any_in_world()) return;
  for (std::size_t i = 0; i < scene.body.size(); ++i)
    if (scene.body[i].surface.fill) drawn_[i] = lines_of_surface(surfaces[i]);
}

bool Overlays::has_any_in_world() const {
  const bool labels =
      std::any_of(labels_.begin(), labels_.end(), [](const Labels& l) { return !l.is_empty(); });
  return has_any(wireframes_) || has_any(ghosts_) || labels || shows_face_orientations() ||
         !glyphs_.is_empty();
}

bool Overlays::shows_face_orientations() const {
  return std::any_of(scene_.body.begin(), scene_.body.end(),
                     [](const BodyDesc& b) { return b.surface.face_orientation && b.surface.fill; });
}

void Overlays::see(int frame, const StateRecord& state, const sim::VecX& q) {
  if (needs_positions()) most_ = std::max(most_, glyphs_.largest_displacement(q));
  if (!scene_.energy_plot.show) return;
  const sim::Energies& e = state.energy;
  const EnergySample sample{state.time, e.kinetic, e.elastic, e.gravitational, e.total()};
  if (!std::isfinite(sample.total)) return;  // it is where all others are
  const bool first = energies_.empty();
  for (const std::string& curve : scene_.energy_plot.curves) {
    const double energy = energy_of(sample, curve);
    const bool none = first && &curve == &scene_.energy_plot.curves.front();
    axes_.energy = {none ? energy : std::min(axes_.energy[0], energy),
                    none ? energy : std::max(axes_.energy[1], energy)};
  }
  energies_[frame] = sample;
}

std::map<std::string, std::array<double, 2>> Overlays::ranges() const {
  std::map<std::string, std::array<double, 2>> all;
  if (scene_.glyphs.displacement_every > 0) all["glyphs.displacement"] = {0.0, most_};
  if (scene_.energy_plot.show) {
    all["energy_plot.time"] = {0.0, std::max(1, scene_.time.frames - 1) / scene_.time.fps};
    all["energy_plot.energy"] = scene_.energy_plot.range.value_or(axes_.energy);
  }
  return all;
}

View Overlays::view_of(const render::Camera& camera, const sim::VecX& q, bool see_through_hide) const {
  View view(camera, scene_.ground);
  int first_item = 0;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const BodyLines& body = drawn_[i];
    if (body.mesh.triangles.empty() || !hides(i, see_through_hide)) continue;
    view.items().draw(body.mesh.triangles, positions_of(body, q), first_item);
    first_item += static_cast<int>(body.mesh.triangles.size());
  }
  return view;
}

std::vector<float> Overlays::seen_through(const render::Camera& camera, const sim::VecX& q) const {
  ItemBuffer items(camera);
  std::vector<float> lets_through;  // of each item
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    if (!is_see_through(i)) continue;
    items.draw(drawn_[i].mesh.triangles, positions_of(drawn_[i], q), static_cast<int>(lets_through.size()));
    lets_through.resize(lets_through.size() + drawn_[i].mesh.triangles.size(),
                        1.0F - scene_.body[i].look.opacity);
  }
  constexpr int n = ItemBuffer::samples;
  std::vector<float> shares;
  shares.reserve(static_cast<std::size_t>(camera.width()) * static_cast<std::size_t>(camera.height()));
  for (int y = 0; y < camera.height(); ++y) {
    for (int x = 0; x < camera.width(); ++x) {
      float sum = 0.0F, count = 0.0F;
      for (int s = 0; s < n * n; ++s) {
        const int item = items.item(n * x + s % n, n * y + s / n);
        if (item == ItemBuffer::none) continue;
        sum += lets_through[static_cast<std::size_t>(item)];
        count += 1.0F;
      }
      shares.push_back(count > 0.0F ? sum / count : 0.0F);
    }
  }
  return shares;
}

void Overlays::draw_face_orientations(render::Picture& picture, const render::Camera& camera,
                                      const sim::VecX& q) const {
  if (!shows_face_orientations()) return;
  enum class Side : char { untold, outside, inside };
  std::vector<Side> sides;      // of the items, towards the eye
  std::vector<double> through;  // how much of what is behind it an item lets through
  std::vector<std::vector<render::Vec3>> positions;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const SurfaceDesc& surface = scene_.body[i].surface;
    positions.push_back(positions_of(drawn_[i], q));
    const std::vector<render::Vec3>& x = positions.back();
    for (const auto& [a, b, c] : drawn_[i].mesh.triangles) {
      const render::Vec3 normal = (x[b] - x[a]).cross(x[c] - x[a]);
      const render::Vec3 to_eye =
          camera.is_orthographic() ? render::Vec3(-camera.forward()) : render::Vec3(camera.position() - x[a]);
      const bool outside = (normal.dot(to_eye) > 0.0F) != surface.flip;
      sides.push_back(!surface.face_orientation ? Side::untold : outside ? Side::outside : Side::inside);
    }
    through.resize(sides.size(), 1.0 - static_cast<double>(scene_.body[i].look.opacity));
  }

  constexpr int n = ItemBuffer::samples;
  struct Seen {
    double outside = 0.0, inside = 0.0;
  };
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<Seen> seen(width * static_cast<std::size_t>(picture.height));  // in samples
  View view(camera, scene_.ground);
  const auto columns = static_cast<std::size_t>(view.items().columns());
  std::vector<double> left(columns * static_cast<std::size_t>(view.items().rows()), 1.0);  // of a sample
  constexpr int most_layers = 64;
  constexpr double least = 1.0 / 512.0;  // of a sample that is still to be told
  for (int layer = 0; layer < most_layers; ++layer) {
    int first_item = 0;
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      view.items().draw(drawn_[i].mesh.triangles, positions[i], first_item);
      first_item += static_cast<int>(drawn_[i].mesh.triangles.size());
    }
    bool more = false;
    for (int row = 0; row < view.items().rows(); ++row) {
      for (int column = 0; column < view.items().columns(); ++column) {
        const int item = view.items().item(column, row);
        if (item == ItemBuffer::none) continue;
        double& rest = left[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)];
        // What the ground is in front of is not seen.
        if (rest < least ||
            !view.sees(ViewPoint{(column + 0.5) / n, (row + 0.5) / n, view.items().depth(column, row)})) {
          rest = 0.0;
          continue;
        }
        const auto at = static_cast<std::size_t>(item);
        Seen& pixel = seen[static_cast<std::size_t>(row / n) * width + static_cast<std::size_t>(column / n)];
        if (sides[at] == Side::outside) pixel.outside += rest * (1.0 - through[at]);
        if (sides[at] == Side::inside) pixel.inside += rest * (1.0 - through[at]);
        rest *= through[at];
        more = more || rest >= least;
      }
    }
    if (!more) break;
    view.items().peel();
  }

  constexpr Color blue = {40, 90, 255}, red = {255, 40, 40};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      const double sum = seen[at].outside + seen[at].inside;
      if (!(sum > 0.0)) continue;
      // In place of its own colour, lit as that is.
      const std::uint8_t* own = picture.rgb.data() + 3 * at;
      const double light = 0.35 + 0.65 * (own[0] + own[1] + own[2]) / (3.0 * 255.0);
      const double part = seen[at].outside / sum;
      Color tint;
      for (std::size_t c = 0; c < 3; ++c)
        tint[c] = static_cast<std::uint8_t>(std::lround(light * (part * blue[c] + (1.0 - part) * red[c])));
      blend(picture, x, y, tint, sum / (n * n));
    }
  }
}

void Overlays::draw_ghosts(render::Picture& picture, const View& view) const {
  const sim::VecX rest = sim::as_q(model_.mesh().X);
  for (std::size_t i = 0; i < ghosts_.size(); ++i) {
    if (ghosts_[i].mesh.edges.empty()) continue;
    draw_ghost(picture, view, ghosts_[i].mesh, positions_of(ghosts_[i], rest),
               style_of(scene_.body[i].ghost));
  }
}

void Overlays::draw_wireframes(render::Picture& picture, const View& view, const sim::VecX& q,
                               bool see_through_hide) const {
  for (std::size_t i = 0; i < wireframes_.size(); ++i) {
    const BodyLines& lines = wireframes_[i];
    if (lines.mesh.edges.empty()) continue;
    const std::vector<render::Vec3> x = positions_of(lines, q);
    View with_own = view;  // a mesh hides its own lines, whether it is filled or not
    if (hides(i, see_through_hide)) with_own.items().draw(lines.mesh.triangles, x, own_items(i));
    draw_wireframe(picture, with_own, lines.mesh, x, own_items(i), style_of(scene_.body[i].wireframe));
  }
}

void Overlays::draw_labels(render::Picture& picture, const View& view, const sim::VecX& q) const {
  std::vector<Rectangle> taken;
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    if (labels_[i].is_empty()) continue;
    const std::vector<render::Vec3> x = positions_of(labels_[i].lines(), q);
    View with_own = view;
    with_own.items().draw(labels_[i].lines().mesh.triangles, x, own_items(i));
    labels_[i].draw(picture, with_own, x, own_items(i), taken);
  }
}

void Overlays::draw_in_world(render::Picture& picture, const render::Camera& camera, const sim::State& state,
                             bool see_through_hide) const {
  const View view = view_of(camera, state.q, see_through_hide);
  draw_ghosts(picture, view);
  draw_wireframes(picture, view, state.q, see_through_hide);
  glyphs_.draw(picture, view, state, most_, [&](std::size_t body) { return hides(body, see_through_hide); });
  draw_labels(picture, view, state.q);
}

void Overlays::draw(render::Picture& picture, const render::Camera& camera, const sim::State& state) const {
  if (!has_any_in_world()) return;
  draw_face_orientations(picture, camera, state.q);
  bool any = false;
  for (std::size_t i = 0; i < scene_.body.size(); ++i) any = any || is_see_through(i);
  if (!any) return draw_in_world(picture, camera, state, true);
  // Once as if see-through bodies were solid and once as if they were not there: what differs is behind them.
  render::Picture without = picture;
  draw_in_world(picture, camera, state, true);
  draw_in_world(without, camera, state, false);
  const std::vector<float> shares = seen_through(camera, state.q);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    const int hidden = picture.rgb[i], seen = without.rgb[i];
    picture.rgb[i] = static_cast<std::uint8_t>(
        std::lround(static_cast<float>(hidden) + shares[i / 3] * static_cast<float>(seen - hidden)));
  }
}

void Overlays::draw_energies(render::Picture& picture, OverlayLayout& layout, int frame) const {
  if (!scene_.energy_plot.show || energies_.empty()) return;
  std::vector<EnergySample> so_far;
  for (const auto& [of, sample] : energies_)
    if (of <= frame) so_far.push_back(sample);
  const auto axis = ranges();
  const EnergyAxes axes{.time = axis.at("energy_plot.time"),
                        .energy = axis.at("energy_plot.energy"),
                        .given = scene_.energy_plot.range.has_value(),
                        .curves = scene_.energy_plot.curves};
  if (const auto plate = place_energy_plot(layout, axes, scene_.energy_plot.place))
    draw_energy_plot(picture, so_far, axes, *plate);
}

std::vector<ColorBar> Overlays::bars() const {
  if (scene_.glyphs.displacement_every == 0 || !(most_ > 0.0)) return {};
  return {{"displacement", "m", &render::find_colormap(scene_.glyphs.colormap), 0.0, most_}};
}

std::vector<std::string> Overlays::remarks() const {
  std::vector<std::string> remarks;
  const auto shows_field = [](const BodyDesc& body) { return !body.shown.is_none(); };
  if (scene_.clip && scene_.clip->color && std::all_of(scene_.body.begin(), scene_.body.end(), shows_field))
    remarks.emplace_back("clip.color has no effect: the bodies' fields colour the cut");
  if (scene_.glyphs.loads != "none" && model_.load_force(0.0).size() == 0)
    remarks.emplace_back("glyphs.loads has no effect: no body has a load");
  for (std::size_t i = 0; i < scene_.body.size(); ++i) {
    const BodyDesc& body = scene_.body[i];
    if (body.look.transmission > 0.0F &&
        (apps::shows_field(scene_, i) || (scene_.clip && scene_.clip->color)))
      remarks.push_back(fmt::format("body.{}.look.transmission has no effect: its surface shows colours", i));
    if (scene_.clip && body.surface.subdivide > 0)
      remarks.push_back(fmt::format("body.{}.surface.subdivide has no effect: clip shows the tets", i));
    if (!body.surface.fill && !body.wireframe.show) {
      remarks.push_back(fmt::format(
          "body.{}.surface.fill = false without body.{}.wireframe.show: the surface of '{}' is not drawn", i,
          i, body.physics.name));
    }
    if (!body.surface.fill && shows_field(body)) {
      remarks.push_back(fmt::format("body.{}.look.field has no effect: the surface of '{}' is not drawn", i,
                                    body.physics.name));
    }
    if (!body.surface.fill && body.surface.face_orientation) {
      remarks.push_back(
          fmt::format("body.{}.surface.face_orientation has no effect: the surface of '{}' is not drawn", i,
                      body.physics.name));
    }
    if (const std::optional<std::string> remark = labels_[i].remark(body.physics.name))
      remarks.push_back(*remark);
  }
  return remarks;
}

bool needs_sequence(const SceneDesc& scene) {
  return has_automatic_range(scene) || scene.energy_plot.show || scene.glyphs.displacement_every > 0;
}

}  // namespace lagomorph::apps
