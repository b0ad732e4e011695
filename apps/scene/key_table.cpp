#include <utility>

#include <fmt/format.h>

#include "apps/scene/keys.h"
#include "apps/scene/scene.h"
#include "apps/scene/values.h"

namespace lagomorph::apps {
namespace {

/// A row a key, under a row a table.
class MarkdownTable : public KeyVisitor {
public:
  std::string text = "| Key | Default | Unit | Valid | Meaning |\n|---|---|---|---|---|\n";

  void key(const Key& k, Field field) override {
    text += fmt::format("| `{}{}` | {} | {} | {} | {} |\n", path_, k.name, default_of(k, field), k.unit,
                        valid(k), escaped(k.meaning));
  }

  void table(const Table& about, const Elements& elements) override {
    const bool list = elements.kind == Elements::Kind::list;
    const std::string outer =
        std::exchange(path_, fmt::format("{}{}{}.", path_, about.name, list ? ".N" : ""));
    text += fmt::format("| **`{}`** | {} | | | {} |\n", path_.substr(0, path_.size() - 1),
                        about.required         ? "required"
                        : elements.size() == 0 ? "none"
                                               : "",
                        escaped(about.meaning));
    if (elements.size() == 0) elements.resize(1);
    elements.visit(0, *this);
    path_ = outer;
  }

private:
  static std::string default_of(const Key& k, const Field& field) {
    if (k.required) return "required";
    if (k.default_note != nullptr) return k.default_note;
    const std::optional<std::string> value = toml_value(field);
    return value ? "`" + *value + "`" : "none";
  }

  static std::string valid(const Key& k) {
    if (k.choices == nullptr) return valid_numbers(k);
    std::string all;
    for (const std::string& choice : shown_choices(k)) all += (all.empty() ? "`" : ", `") + choice + "`";
    return all;
  }

  /// A bar would begin another column.
  static std::string escaped(const std::string& words) {
    std::string all;
    for (const char c : words) all += c == '|' ? "\\|" : std::string(1, c);
    return all;
  }

  std::string path_;  // of the table, with a point behind it
};

}  // namespace

std::string scene_key_table_markdown() {
  SceneDesc scene = default_scene();
  MarkdownTable table;
  visit_scene(scene, table);
  return table.text;
}

}  // namespace lagomorph::apps
