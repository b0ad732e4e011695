#include "apps/pipeline/surface_fields.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace lagomorph::apps {
namespace {

/// A value that stands in the middle of a diverging map: volumes that did not change.
const double* neutral_value(const sim::FieldInfo& field) {
  static constexpr double one = 1.0;
  return std::string_view(field.name) == "J" ? &one : nullptr;
}

}  // namespace

std::vector<double> surface_values(const sim::Surface& surface, const std::vector<double>& vertices) {
  sim::VecX as_x = sim::VecX::Zero(3 * static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v) as_x(3 * static_cast<Eigen::Index>(v)) = vertices[v];
  const sim::Points carried = surface.positions(as_x);
  std::vector<double> values(static_cast<std::size_t>(carried.rows()));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = carried(static_cast<Eigen::Index>(i), 0);
  return values;
}

const render::Colormap& colormap_of(const ShownField& shown) {
  if (shown.colormap != "auto") return render::find_colormap(shown.colormap);
  return render::find_colormap(shown.field == "J" ? "coolwarm" : "viridis");
}

SurfaceFields::SurfaceFields(const SceneDesc& scene, const sim::Model& model,
                             const std::vector<sim::Surface>& surfaces)
    : scene_(scene), model_(model), surfaces_(surfaces) {
  for (const BodyDesc& body : scene.body) {
    const ShownField& shown = body.shown;
    scale_of_body_.push_back(none);
    if (shown.is_none()) continue;
    Scale wanted{sim::find_field(shown.field),
                 &colormap_of(shown),
                 !shown.range,
                 shown.color_bar,
                 shown.range ? (*shown.range)[0] : 1.0,
                 shown.range ? (*shown.range)[1] : -1.0};
    const auto same = std::find_if(scales_.begin(), scales_.end(), [&](const Scale& s) {
      return std::string_view(s.field.name) == wanted.field.name && s.map == wanted.map &&
             s.automatic == wanted.automatic && s.low == wanted.low && s.high == wanted.high;
    });
    scale_of_body_.back() = static_cast<std::size_t>(same - scales_.begin());
    if (same == scales_.end()) {
      scales_.push_back(wanted);
    } else {
      same->bar = same->bar || wanted.bar;
    }
    if (std::find(names_.begin(), names_.end(), shown.field) == names_.end()) names_.push_back(shown.field);
  }
}

bool SurfaceFields::is_automatic() const {
  return std::any_of(scales_.begin(), scales_.end(), [](const Scale& s) { return s.automatic; });
}

void SurfaceFields::for_values(const sim::VecX& q, const auto& visit) const {
  const std::vector<sim::Field> fields = sim::fields_of(model_, q, names_);
  for (std::size_t body = 0; body < surfaces_.size(); ++body) {
    if (scale_of_body_[body] == none) continue;
    const auto name = std::find(names_.begin(), names_.end(), scene_.body[body].shown.field);
    const sim::Field& field = fields[static_cast<std::size_t>(name - names_.begin())];
    visit(body, scale_of_body_[body], surface_values(surfaces_[body], field.vertices));
  }
}

void SurfaceFields::see(const sim::VecX& q) {
  for_values(q, [&](std::size_t, std::size_t scale, const std::vector<double>& values) {
    Scale& s = scales_[scale];
    if (!s.automatic) return;
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      const bool first = s.low > s.high;
      s.low = first ? value : std::min(s.low, value);
      s.high = first ? value : std::max(s.high, value);
    }
  });
}

/// Never empty: around one value a tenth of it, above 0 the unit. Even around the middle of a diverging map.
/// An end that is 0 but for rounding is 0.
std::array<double, 2> SurfaceFields::range_of(const Scale& s) {
  if (!s.automatic) return {s.low, s.high};
  double low = s.low, high = s.high;
  if (low > high) low = 0.0, high = 0.0;
  if (const double* middle = neutral_value(s.field); middle != nullptr && s.map->diverging) {
    const double reach = std::max(std::abs(high - *middle), std::abs(low - *middle));
    low = *middle - reach, high = *middle + reach;
  }
  const double size = std::max(std::abs(low), std::abs(high));
  if (std::abs(low) < 1e-9 * size) low = 0.0;
  if (std::abs(high) < 1e-9 * size) high = 0.0;
  if (size == 0.0) return {0.0, 1.0};
  if (high - low > 1e-6 * size) return {low, high};
  return {low - 0.1 * size, high + 0.1 * size};
}

std::string SurfaceFields::names_of(std::size_t scale) const {
  std::string names;
  for (std::size_t body = 0; body < scale_of_body_.size(); ++body) {
    if (scale_of_body_[body] != scale) continue;
    names += (names.empty() ? "" : ", ") + scene_.body[body].physics.name;
  }
  return names;
}

std::vector<Category> SurfaceFields::bodies_of(std::size_t scale) const {
  std::vector<Category> bodies;
  for (std::size_t body = 0; body < scale_of_body_.size(); ++body)
    if (scale_of_body_[body] == scale)
      bodies.push_back({scene_.body[body].physics.name, static_cast<double>(body)});
  return bodies;
}

std::vector<ColorBar> SurfaceFields::bars() const {
  std::vector<ColorBar> all;
  for (std::size_t i = 0; i < scales_.size(); ++i) {
    const Scale& s = scales_[i];
    if (!s.bar) continue;
    const auto [low, high] = range_of(s);
    const std::string title =
        scales_.size() > 1 ? names_of(i) + ": " + s.field.title : std::string(s.field.title);
    all.push_back({title, s.field.unit, s.map, low, high, !s.automatic});
    if (std::string_view(s.field.name) != "body") continue;
    all.back().title = s.field.title;
    all.back().categories = bodies_of(i);
  }
  return all;
}

std::vector<ColorBar> SurfaceFields::bars(const sim::VecX& q) const {
  std::vector<ColorBar> all = bars();
  if (std::none_of(all.begin(), all.end(), [](const ColorBar& bar) { return bar.given; })) return all;
  std::vector<std::size_t> bar_of(scales_.size(), none);
  for (std::size_t i = 0, bar = 0; i < scales_.size(); ++i)
    if (scales_[i].bar) bar_of[i] = bar++;
  for_values(q, [&](std::size_t body, std::size_t scale, const std::vector<double>& values) {
    if (bar_of[scale] == none || !scene_.body[body].surface.fill) return;
    ColorBar& bar = all[bar_of[scale]];
    if (!bar.given) return;
    const double slack = 1e-6 * (bar.high - bar.low);  // values that are an end's but for rounding
    for (const double value : values) {
      bar.below = bar.below || value < bar.low - slack;
      bar.above = bar.above || value > bar.high + slack;
    }
  });
  return all;
}

std::map<std::string, std::array<double, 2>> SurfaceFields::ranges() const {
  std::map<std::string, std::array<double, 2>> all;
  for (std::size_t body = 0; body < scale_of_body_.size(); ++body) {
    if (scale_of_body_[body] != none)
      all[scene_.body[body].physics.name] = range_of(scales_[scale_of_body_[body]]);
  }
  return all;
}

double SurfaceFields::spread(const sim::VecX& q) const {
  double most = 0.0;
  for_values(q, [&](std::size_t, std::size_t scale, const std::vector<double>& values) {
    const auto [low, high] = range_of(scales_[scale]);
    double least_value = high, most_value = low;
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      const double shown = std::clamp(value, low, high);
      least_value = std::min(least_value, shown);
      most_value = std::max(most_value, shown);
    }
    most = std::max(most, (most_value - least_value) / (high - low));
  });
  return most;
}

std::vector<std::vector<render::Color>> SurfaceFields::colors(const sim::VecX& q) const {
  std::vector<std::vector<render::Color>> all(surfaces_.size());
  if (is_empty()) return all;
  for_values(q, [&](std::size_t body, std::size_t scale, const std::vector<double>& values) {
    const Scale& s = scales_[scale];
    const auto [low, high] = range_of(s);
    for (const double value : values)
      all[body].push_back(render::color_of(*s.map, static_cast<float>((value - low) / (high - low))));
  });
  return all;
}

void SurfaceFields::color_meshes(render::Renderer& renderer, const sim::VecX& q) const {
  const std::vector<std::vector<render::Color>> all = colors(q);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].empty()) renderer.update_colors(static_cast<int>(i), all[i]);
  }
}

bool has_automatic_range(const SceneDesc& scene) {
  return std::any_of(scene.body.begin(), scene.body.end(),
                     [](const BodyDesc& body) { return !body.shown.is_none() && !body.shown.range; });
}

}  // namespace lagomorph::apps
