#include "apps/scene/read.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/scene/document.h"
#include "apps/scene/keys.h"
#include "apps/scene/read_value.h"
#include "apps/scene/unknown_key.h"

namespace lagomorph::apps {
namespace {

/// Names of the keys and tables that stand directly in a table.
class NameCollector : public KeyVisitor {
public:
  std::vector<std::string> names;
  void key(const Key& k, Field) override { names.emplace_back(k.name); }
  void table(const Table& t, const Elements&) override { names.emplace_back(t.name); }
};

/// Reads the values that a document gives into a description.
class Reader : public KeyVisitor {
public:
  Reader(const Document& document, Places& places) : document_(document), places_(places) {}

  void read(SceneDesc& scene) {
    places_.add("", document_.place({}));
    read_table(document_.root(), "", "at the top", [&](KeyVisitor& v) { visit_scene(scene, v); });
  }

  void key(const Key& k, Field field) override {
    const std::string path = path_of(k.name);
    const toml::node* node = table_->get(k.name);
    if (node == nullptr) {
      if (!k.required) return;
      wrong_input(fmt::format("{}{} is missing: {}", table_place_, path, k.meaning));
    }
    places_.add(path, document_.place(node->source()));
    read_value(document_, k, path, *node, field);
  }

  void table(const Table& about, const Elements& elements) override {
    const std::string path = path_of(about.name);
    const toml::node* node = table_->get(about.name);
    if (node == nullptr) return;
    places_.add(path, document_.place(node->source()));
    if (elements.kind == Elements::Kind::list) {
      read_list(path, *node, elements);
      return;
    }
    const toml::table* inside = node->as_table();
    if (inside == nullptr) {
      const std::string remedy =
          node->is_array_of_tables() ? fmt::format("; write [{0}], not [[{0}]]", about.name) : std::string();
      wrong_input(fmt::format("{}{} must be a table, not {}{}", document_.place(node->source()), path,
                              told(*node), remedy));
    }
    elements.resize(1);
    read_table(*inside, path, fmt::format("in [{}]", about.name),
               [&](KeyVisitor& v) { elements.visit(0, v); });
  }

private:
  std::string path_of(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }

  void read_list(const std::string& path, const toml::node& node, const Elements& elements) {
    const toml::array* array = node.as_array();
    if (array == nullptr) {
      const std::string remedy =
          node.is_table() ? fmt::format(": write [[{0}]], not [{0}]", title_of(path)) : std::string();
      wrong_input(fmt::format("{}{} must be an array of tables, not {}{}", document_.place(node.source()),
                              path, told(node), remedy));
    }
    elements.resize(0);
    elements.resize(static_cast<int>(array->size()));
    for (int i = 0; i < static_cast<int>(array->size()); ++i) {
      const toml::node& element = *array->get(static_cast<std::size_t>(i));
      const std::string element_path = fmt::format("{}.{}", path, i);
      if (!element.is_table()) {
        wrong_input(fmt::format("{}{} must be a table, not {}", document_.place(element.source()),
                                element_path, told(element)));
      }
      places_.add(element_path, document_.place(element.source()));
      read_table(*element.as_table(), element_path, fmt::format("in [[{}]]", title_of(path)),
                 [&](KeyVisitor& v) { elements.visit(i, v); });
    }
  }

  /// A path without its indices: the name in a header.
  static std::string title_of(const std::string& path) {
    std::string title;
    std::size_t begin = 0;
    while (begin <= path.size()) {
      const std::size_t end = std::min(path.find('.', begin), path.size());
      const std::string segment = path.substr(begin, end - begin);
      if (segment.find_first_not_of("0123456789") != std::string::npos)
        title += (title.empty() ? "" : ".") + segment;
      begin = end + 1;
    }
    return title;
  }

  template <class Visit>
  void read_table(const toml::table& table, const std::string& path, const std::string& where, Visit visit) {
    NameCollector known;
    visit(known);
    check_names(table, known.names, where);
    const toml::table* outer_table = std::exchange(table_, &table);
    const std::string outer_path = std::exchange(path_, path);
    const std::string outer_place = std::exchange(table_place_, document_.place(table.source()));
    visit(*this);
    table_ = outer_table;
    path_ = outer_path;
    table_place_ = outer_place;
  }

  void check_names(const toml::table& table, const std::vector<std::string>& known,
                   const std::string& where) {
    const toml::key* first = nullptr;  // in the file's order; the table's is the alphabet's
    for (const auto& [key, node] : table) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      if (first == nullptr || key.source().begin < first->source().begin) first = &key;
    }
    if (first == nullptr) return;
    const std::string name(first->str());
    wrong_input(fmt::format("{}unknown key '{}'; {}", document_.place(first->source()), name,
                            unknown_key_hint(name, known, where)));
  }

  const Document& document_;
  Places& places_;
  const toml::table* table_ = nullptr;  // whose keys are being shown
  std::string path_;                    // of it
  std::string table_place_;             // of it
};

}  // namespace

std::string Places::of(std::string path) const {
  while (true) {
    const auto found = places_.find(path);
    if (found != places_.end()) return found->second;
    const std::size_t dot = path.rfind('.');
    path = dot == std::string::npos ? "" : path.substr(0, dot);
  }
}

SceneDesc read_scene(std::string_view text, const std::string& origin, std::span<const std::string> overrides,
                     Places& places) {
  const Document document(text, origin, overrides);
  SceneDesc scene = default_scene();
  Reader(document, places).read(scene);
  return scene;
}

}  // namespace lagomorph::apps
