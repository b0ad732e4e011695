#include "apps/scene/read.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/nearest.h"
#include "apps/scene/document.h"
#include "apps/scene/keys.h"

namespace lagomorph::apps {
namespace {

[[noreturn]] void wrong(const std::string& what) { throw Error(ExitStatus::wrong_input, what); }

/// What was found, in words.
std::string told(const toml::node& node) {
  constexpr std::size_t longest = 40;  // of a string in a message
  if (const auto* s = node.as_string()) {
    return s->get().size() > longest ? "a string" : fmt::format("the string \"{}\"", s->get());
  }
  if (const auto* i = node.as_integer()) return fmt::format("{}", i->get());
  if (const auto* x = node.as_floating_point()) {
    const std::string digits = fmt::format("{}", x->get());
    return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
  }
  if (const auto* b = node.as_boolean()) return b->get() ? "true" : "false";
  if (node.is_array_of_tables()) return "an array of tables";
  if (node.is_array()) return "an array";
  if (node.is_table()) return "a table";
  return "a date or time";
}

/// Names of the keys and tables that stand directly in a table.
class NameCollector : public KeyVisitor {
public:
  std::vector<std::string> names;
  void key(const Key& k, Field) override { names.emplace_back(k.name); }
  void table(const Table& t, const Elements&) override { names.emplace_back(t.name); }
};

/// "[body.surface]", "[[body]]" of every table that has a key of this name.
class Owners : public KeyVisitor {
public:
  explicit Owners(std::string name) : name_(std::move(name)) {}
  std::vector<std::string> titles;
  void key(const Key& k, Field) override {
    if (k.name == name_ && !title_.empty()) titles.push_back(title_);
  }
  void table(const Table& t, const Elements& elements) override {
    const std::string path = (path_.empty() ? "" : path_ + ".") + t.name;
    const bool list = elements.kind == Elements::Kind::list;
    const std::string outer_path = std::exchange(path_, path);
    const std::string outer_title = std::exchange(title_, (list ? "[[" : "[") + path + (list ? "]]" : "]"));
    if (elements.size() == 0) elements.resize(1);
    elements.visit(0, *this);
    path_ = outer_path;
    title_ = outer_title;
  }

private:
  std::string name_, path_, title_;
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
      wrong(fmt::format("{}{} is missing: {}", table_place_, path, k.meaning));
    }
    places_.add(path, document_.place(node->source()));
    std::visit([&](auto* value) { read_value(k, path, *node, *value); }, field);
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
      wrong(fmt::format("{}{} must be a table, not {}{}", document_.place(node->source()), path, told(*node),
                        remedy));
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
      wrong(fmt::format("{}{} must be an array of tables, not {}{}", document_.place(node.source()), path,
                        told(node), remedy));
    }
    elements.resize(0);
    elements.resize(static_cast<int>(array->size()));
    for (int i = 0; i < static_cast<int>(array->size()); ++i) {
      const toml::node& element = *array->get(static_cast<std::size_t>(i));
      const std::string element_path = fmt::format("{}.{}", path, i);
      if (!element.is_table()) {
        wrong(fmt::format("{}{} must be a table, not {}", document_.place(element.source()), element_path,
                          told(element)));
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
    const std::string near = nearest(name, known);
    std::string hint;
    if (!near.empty()) {
      hint = fmt::format("did you mean '{}'?", near);
    } else {
      Owners owners(name);
      SceneDesc any;
      visit_scene(any, owners);
      hint = owners.titles.empty() ? fmt::format("known {} are {}", where, joined(known))
                                   : fmt::format("it belongs in {}", joined(owners.titles));
    }
    wrong(fmt::format("{}unknown key '{}'; {}", document_.place(first->source()), name, hint));
  }

  [[noreturn]] void wrong_type(const std::string& path, const toml::node& node, const std::string& expected) {
    wrong(fmt::format("{}{} must be {}, not {}", document_.place(node.source()), path, expected, told(node)));
  }

  /// A number in its range, as a double.
  double number(const Key& k, const std::string& path, const toml::node& node) {
    double x = 0.0;
    if (const auto* i = node.as_integer()) {
      x = static_cast<double>(i->get());
    } else if (const auto* f = node.as_floating_point()) {
      x = f->get();
    } else {
      wrong_type(path, node, "a number");
    }
    if (!std::isfinite(x)) wrong_type(path, node, "a finite number");
    check_range(k, path, node, x);
    return x;
  }

  void check_range(const Key& k, const std::string& path, const toml::node& node, double x) {
    if (k.bounds.hold(x) && (k.holds == nullptr || k.holds(x))) return;
    const std::string bounds = k.bounds.text();
    const std::string rule = k.rule == nullptr ? "" : (bounds.empty() ? "" : ", ") + std::string(k.rule);
    wrong(fmt::format("{}{} = {} is out of range; it must be {}{}", document_.place(node.source()), path,
                      told(node), bounds, rule));
  }

  template <class Int>
  Int integer(const Key& k, const std::string& path, const toml::node& node) {
    const auto* i = node.as_integer();
    if (i == nullptr) wrong_type(path, node, "an integer");
    constexpr auto low = static_cast<std::int64_t>(std::numeric_limits<Int>::min());
    constexpr auto high = static_cast<std::int64_t>(std::numeric_limits<Int>::max());
    check_range(k, path, node, static_cast<double>(i->get()));
    if (i->get() < low || i->get() > high) {
      wrong(fmt::format("{}{} = {} is out of range; it must be in {} .. {}", document_.place(node.source()),
                        path, i->get(), low, high));
    }
    return static_cast<Int>(i->get());
  }

  /// `size` elements; any number of them when it is negative.
  const toml::array& array(const std::string& path, const toml::node& node, int size, const std::string& of) {
    const toml::array* a = node.as_array();
    const std::string expected = size < 0 ? "an array of " + of : fmt::format("an array of {} {}", size, of);
    if (a == nullptr) wrong_type(path, node, expected);
    if (size >= 0 && a->size() != static_cast<std::size_t>(size)) {
      wrong(fmt::format("{}{} must be {}, not of {}", document_.place(node.source()), path, expected,
                        a->size()));
    }
    return *a;
  }

  std::string string(const Key& k, const std::string& path, const toml::node& node) {
    const auto* s = node.as_string();
    if (s == nullptr) wrong_type(path, node, "a string");
    if (k.choices == nullptr) return s->get();
    const std::vector<std::string> choices = k.choices();
    if (std::find(choices.begin(), choices.end(), s->get()) == choices.end()) {
      const std::string near = nearest(s->get(), choices);
      wrong(fmt::format("{}unknown {} '{}'; {}known are {}", document_.place(node.source()), path, s->get(),
                        near.empty() ? "" : fmt::format("did you mean '{}'? ", near), joined(choices)));
    }
    return s->get();
  }

  void read_value(const Key&, const std::string& path, const toml::node& node, bool& value) {
    if (!node.is_boolean()) wrong_type(path, node, "true or false");
    value = node.as_boolean()->get();
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, int& value) {
    value = integer<int>(k, path, node);
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, std::uint32_t& value) {
    value = integer<std::uint32_t>(k, path, node);
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, double& value) {
    value = number(k, path, node);
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, float& value) {
    value = static_cast<float>(number(k, path, node));
    // A valid double may be infinite, or on an open bound, as a float.
    if (!std::isfinite(value) || !k.bounds.hold(static_cast<double>(value))) {
      wrong(fmt::format("{}{} = {} is out of the range of single precision", document_.place(node.source()),
                        path, told(node)));
    }
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, std::string& value) {
    value = string(k, path, node);
  }
  template <class T>
  void read_value(const Key& k, const std::string& path, const toml::node& node, std::optional<T>& value) {
    read_value(k, path, node, value.emplace());
  }
  /// Vectors and colours.
  template <int n, class Scalar>
  void read_elements(const Key& k, const std::string& path, const toml::node& node, Scalar* values) {
    const toml::array& a = array(path, node, n, "numbers");
    for (int i = 0; i < n; ++i) {
      read_value(k, fmt::format("{}.{}", path, i), *a.get(static_cast<std::size_t>(i)), values[i]);
    }
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, sim::Vec3& value) {
    read_elements<3>(k, path, node, value.data());
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, render::Vec2& value) {
    read_elements<2>(k, path, node, value.data());
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, render::Vec3& value) {
    read_elements<3>(k, path, node, value.data());
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, render::Color& value) {
    read_elements<3>(k, path, node, value.data());
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, sim::BoxSelector& value) {
    const toml::array& a = array(path, node, 2, "corners, [[x, y, z], [x, y, z]]");
    read_value(k, path + ".0", *a.get(0), value.min);
    read_value(k, path + ".1", *a.get(1), value.max);
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node, std::vector<int>& value) {
    const toml::array& a = array(path, node, -1, "integers");
    value.clear();
    for (std::size_t i = 0; i < a.size(); ++i) {
      value.push_back(integer<int>(k, fmt::format("{}.{}", path, i), *a.get(i)));
    }
  }
  void read_value(const Key& k, const std::string& path, const toml::node& node,
                  std::vector<std::string>& value) {
    const toml::array& a = array(path, node, -1, "strings");
    value.clear();
    for (std::size_t i = 0; i < a.size(); ++i) {
      value.push_back(string(k, fmt::format("{}.{}", path, i), *a.get(i)));
    }
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
  SceneDesc scene;
  scene.light.emplace_back();  // the key light of a scene that names none
  Reader(document, places).read(scene);
  return scene;
}

}  // namespace lagomorph::apps
