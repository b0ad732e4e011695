#include "apps/scene/unknown_key.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "apps/nearest.h"
#include "apps/scene/keys.h"

namespace lagomorph::apps {
namespace {

/// Every key with the title of the table that has it: "[body.surface]", "[[body]]".
class AllKeys : public KeyVisitor {
public:
  struct Row {
    std::string name, title;
  };
  std::vector<Row> rows;
  void key(const Key& k, Field) override {
    if (!path_.empty()) rows.push_back({k.name, title_});
  }
  void table(const Table& t, const Elements& elements) override {
    const std::string path = (path_.empty() ? "" : path_ + ".") + t.name;
    const bool list = elements.kind == Elements::Kind::list;
    const std::string outer_path = std::exchange(path_, path);
    const std::string outer_title =
        std::exchange(title_, list ? fmt::format("[[{}]]", path) : fmt::format("[{}]", path));
    if (elements.size() == 0) elements.resize(1);
    elements.visit(0, *this);
    path_ = outer_path;
    title_ = outer_title;
  }

private:
  std::string path_, title_;
};

/// What other programs call it; "" where that is no key here.
std::string by_another_name(const std::string& name, const std::vector<std::string>& known_here) {
  static const std::map<std::string, std::string> names = {{"albedo", "base_color"},
                                                           {"alpha", "opacity"},
                                                           {"clearcoat", "coat"},
                                                           {"diffuse", "base_color"},
                                                           {"e", "young"},
                                                           {"metalness", "metallic"},
                                                           {"nu", "poisson"},
                                                           {"rho", "density"},
                                                           {"shininess", "roughness"},
                                                           {"specular", "ior"},
                                                           {"youngs_modulus", "young"},
                                                           {"poissons_ratio", "poisson"}};
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = names.find(lower);
  const bool here = found != names.end() &&
                    std::find(known_here.begin(), known_here.end(), found->second) != known_here.end();
  return here ? found->second : "";
}

}  // namespace

std::string unknown_key_hint(const std::string& name, const std::vector<std::string>& known_here,
                             const std::string& where) {
  const std::string meant = by_another_name(name, known_here);
  if (!meant.empty()) return fmt::format("here it is '{}'", meant);
  const std::string near = nearest(name, known_here);
  if (!near.empty()) return fmt::format("did you mean '{}'?", near);
  SceneDesc any;
  AllKeys all;
  visit_scene(any, all);
  std::vector<std::string> names;
  for (const AllKeys::Row& row : all.rows) names.push_back(row.name);
  const std::string elsewhere = nearest(name, names);
  std::vector<std::string> titles;
  for (const AllKeys::Row& row : all.rows) {
    if (row.name == elsewhere) titles.push_back(row.title);
  }
  if (elsewhere == name) return fmt::format("it belongs in {}", joined(titles));
  if (!elsewhere.empty()) return fmt::format("did you mean '{}' of {}?", elsewhere, joined(titles));
  return fmt::format("known {} are {}", where, joined(known_here));
}

}  // namespace lagomorph::apps
