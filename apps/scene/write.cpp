#include <utility>

#include <fmt/format.h>

#include "apps/scene/keys.h"
#include "apps/scene/scene.h"
#include "apps/scene/values.h"

namespace lagomorph::apps {
namespace {

/// Writes a scene: the keys of a table first, its sub-tables below, as TOML wants them.
class Writer : public KeyVisitor {
public:
  void key(const Key& k, Field field) override {
    const std::optional<std::string> value = toml_value(field);
    if (inline_) {
      if (value) keys_ += fmt::format("{}{} = {}", keys_.empty() ? "" : ", ", k.name, *value);
      return;
    }
    const std::string unit = *k.unit == '\0' ? "" : fmt::format("  # {}", k.unit);
    keys_ +=
        value ? fmt::format("{} = {}{}\n", k.name, *value, unit) : fmt::format("# {} is not given\n", k.name);
  }

  void table(const Table& about, const Elements& elements) override {
    const int size = elements.size();
    const bool list = elements.kind == Elements::Kind::list;
    if (list && size == 0) keys_ += fmt::format("{} = []\n", about.name);
    for (int i = 0; i < size; ++i) {
      Writer inside;
      inside.inline_ = about.is_inline;
      inside.path_ = (path_.empty() ? "" : path_ + ".") + about.name;
      elements.visit(i, inside);
      if (inline_) {
        keys_ += fmt::format("{}{} = {{ {} }}", keys_.empty() ? "" : ", ", about.name, inside.keys_);
      } else if (about.is_inline) {
        keys_ += fmt::format("{} = {{ {} }}\n", about.name, inside.keys_);
      } else {
        tables_ += (list ? fmt::format("\n[[{}]]\n", inside.path_) : fmt::format("\n[{}]\n", inside.path_)) +
                   inside.text();
      }
    }
  }

  std::string text() const { return keys_ + tables_; }

private:
  bool inline_ = false;
  std::string path_;
  std::string keys_, tables_;
};

}  // namespace

std::string scene_to_toml(const SceneDesc& scene) {
  SceneDesc shown = scene;
  Writer writer;
  visit_scene(shown, writer);
  return "# Every key of the scene with its value. Lengths in metres, all units SI.\n" + writer.text();
}

}  // namespace lagomorph::apps
