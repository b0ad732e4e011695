#include "apps/pipeline/labels.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/overlay/shapes.h"
#include "apps/overlay/stroke_font.h"

namespace lagomorph::apps {
namespace {

constexpr Color vertex_color = {255, 244, 200}, face_color = {170, 214, 255};

/// So many apart that there are at most so many.
int spacing(std::size_t count, int most) {
  const auto limit = static_cast<std::size_t>(most);
  return static_cast<int>(std::max<std::size_t>(1, (count + limit - 1) / limit));
}

std::string ordinal(int n) {
  const bool teen = n % 100 >= 11 && n % 100 <= 13;
  const char* end = teen || n % 10 > 3 || n % 10 == 0 ? "th" : n % 10 == 1 ? "st" : n % 10 == 2 ? "nd" : "rd";
  return fmt::format("{}{}", n, end);
}

}  // namespace

Labels::Labels(const SceneDesc& scene, const sim::Model& model, const std::vector<sim::Surface>& surfaces,
               std::size_t body) {
  const LabelsDesc& wanted = scene.body[body].labels;
  if (!wanted.vertices && !wanted.faces) return;
  lines_ = lines_of(scene, model, surfaces, body, wanted.of);
  if (lines_.surface == nullptr) first_vertex_ = model.mesh().bodies[body].vertices.begin;
  for (const render::Triangle& t : lines_.mesh.triangles)
    vertices_.insert(vertices_.end(), t.begin(), t.end());
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  if (wanted.vertices) every_vertex_ = spacing(vertices_.size(), wanted.most);
  if (wanted.faces) every_face_ = spacing(lines_.mesh.triangles.size(), wanted.most);
}

void Labels::draw(render::Picture& picture, const View& view, const std::vector<render::Vec3>& x,
                  int first_item, std::vector<Rectangle>& taken) const {
  const double height = std::max(6.0, 0.85 * overlay_text_height(picture));
  const std::vector<render::Triangle>& triangles = lines_.mesh.triangles;
  const auto write = [&](const render::Vec3& at, std::size_t number, const Color& color) {
    const ViewPoint p = view_point(view.camera(), at);
    const std::string text = fmt::format("{}", number);
    const double half_width = 0.5 * text_width(text, height) + 2.0, half_height = 0.5 * height + 2.0;
    const Rectangle box{p.x - half_width, p.y - half_height, p.x + half_width, p.y + half_height};
    if (std::any_of(taken.begin(), taken.end(), [&](const Rectangle& r) { return overlap(r, box); })) return;
    taken.push_back(box);
    draw_rimmed_text(picture, {p.x, p.y}, text, height, color);
  };
  const auto place = [&](int item) { return static_cast<std::size_t>(item - first_item); };
  for (std::size_t i = 0; every_vertex_ > 0 && i < vertices_.size();
       i += static_cast<std::size_t>(every_vertex_)) {
    const std::uint32_t v = vertices_[i];
    if (view.sees(x[v], triangles_with(lines_.mesh, v, first_item)))
      write(x[v], v - static_cast<std::size_t>(first_vertex_), vertex_color);
  }
  for (std::size_t f = 0; every_face_ > 0 && f < triangles.size();
       f += static_cast<std::size_t>(every_face_)) {
    const auto [i, j, k] = triangles[f];
    const render::Vec3 middle = (x[i] + x[j] + x[k]) / 3.0F;
    if (view.sees(middle, [&](int item) { return item >= first_item && place(item) == f; }))
      write(middle, f, face_color);
  }
}

std::optional<std::string> Labels::remark(const std::string& body) const {
  std::string text;
  if (every_vertex_ > 1)
    text = fmt::format("every {} of {} vertices", ordinal(every_vertex_), vertices_.size());
  if (every_face_ > 1) {
    text += text.empty() ? "" : " and ";
    text += fmt::format("every {} of {} faces", ordinal(every_face_), lines_.mesh.triangles.size());
  }
  if (text.empty()) return std::nullopt;
  return fmt::format("{}: {} has its number in the picture, at most labels.most of each", body, text);
}

}  // namespace lagomorph::apps
