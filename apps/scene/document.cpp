#include "apps/scene/document.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace {

constexpr int deepest = 100;  // levels of a dotted key; a scene has 6

/// The parser makes a table of each part of a dotted key, and runs out of stack when there are very many.
void check_depth(std::string_view text, const std::string& origin) {
  int line = 1, dots = 0;
  for (const char c : text) {
    if (c == '.') ++dots;
    if (c == '\n' || c == ',' || c == '=' || c == '[' || c == '{') dots = 0;
    if (c == '\n') ++line;
    if (dots > 10 * deepest)
      wrong_input(fmt::format("{}:{}: a key of more parts than any scene has", origin, line));
  }
}

/// A table of the one key `v`, whose nodes have `source` for their place.
toml::table only_v(const std::string& value, const std::string& source) {
  return toml::parse("v = " + value, source);
}

/// VALUE of an override as a node under `v`: TOML, or the string itself when it is none.
toml::table parse_value(const std::string& value, const std::string& source) {
  check_depth(value, source);
  try {
    toml::table parsed = only_v(value, source);
    if (parsed.size() == 1) return parsed;  // a line break in it could begin another key
  } catch (const toml::parse_error&) {
    // No TOML, so a string.
  }
  toml::table text = only_v("''", source);
  try {
    // Takes what a string may hold, and no other bytes.
    *text.get_as<std::string>("v") = toml::parse("v = '''\n" + value + "'''").get_as<std::string>("v")->get();
  } catch (const toml::parse_error&) {
    wrong_input(source + ": the value is neither TOML nor a line of UTF-8 text");
  }
  return text;
}

std::vector<std::string> segments_of(const std::string& path, const std::string& source) {
  std::vector<std::string> segments(1);
  for (const char c : path) {
    if (c == '.') {
      segments.emplace_back();
    } else {
      segments.back() += c;
    }
  }
  if (segments.size() > deepest) wrong_input(source + ": a key of more parts than any scene has");
  for (const std::string& s : segments) {
    if (s.empty()) wrong_input(fmt::format("{}: the key '{}' has an empty part", source, path));
  }
  return segments;
}

std::optional<std::size_t> index_of(const std::string& segment) {
  std::size_t index = 0;
  const char* end = segment.data() + segment.size();
  const auto [stop, error] = std::from_chars(segment.data(), end, index);
  if (error != std::errc() || stop != end) return std::nullopt;
  return index;
}

/// Walks to the place of an override's value and makes what is not there on the way.
class Setter {
public:
  Setter(toml::table& root, std::string source) : node_(&root), source_(std::move(source)) {}

  /// Moves to the child `segment`; makes it, as what `value` holds, when it is not there.
  void enter(const std::string& segment, const std::string& value_if_new) {
    if (toml::node* there = find(segment)) {
      node_ = there;
    } else {
      node_ = put(segment, only_v(value_if_new, source_));
    }
    path_ += (path_.empty() ? "" : ".") + segment;
  }

  /// The value under `v` becomes the child `segment`, in place of what was there. Gives the child.
  toml::node* put(const std::string& segment, toml::table holder) {
    const toml::key key(segment, holder.begin()->first.source());
    toml::node* result = nullptr;
    toml::node* const value = holder.get("v");
    value->visit([&](auto& typed) {
      if (toml::table* table = node_->as_table()) {
        result = &table->insert_or_assign(key, std::move(typed)).first->second;
        return;
      }
      toml::array& array = *node_->as_array();
      const std::size_t index = checked_index(array, segment);
      if (index == array.size()) {
        array.push_back(std::move(typed));
      } else {
        array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(index), std::move(typed));
      }
      result = array.get(index);
    });
    return result;
  }

  /// The child goes, with all in it.
  void take_away(const std::string& segment) {
    if (!find(segment)) {
      wrong_input(fmt::format("{}: there is no '{}{}{}' to take away", source_, path_,
                              path_.empty() ? "" : ".", segment));
    }
    if (toml::table* table = node_->as_table()) {
      table->erase(segment);
    } else {
      toml::array& array = *node_->as_array();
      array.erase(array.cbegin() + static_cast<std::ptrdiff_t>(checked_index(array, segment)));
    }
  }

  toml::node* find(const std::string& segment) {
    if (toml::table* table = node_->as_table()) return table->get(segment);
    if (toml::array* array = node_->as_array()) return array->get(checked_index(*array, segment));
    wrong_input(fmt::format("{}: '{}' is a value, it has no '{}'", source_, path_, segment));
  }

private:
  std::size_t checked_index(const toml::array& array, const std::string& segment) const {
    const std::optional<std::size_t> index = index_of(segment);
    if (!index) {
      wrong_input(fmt::format("{}: '{}' is an array; what follows must be an index, as in {}.0, not '{}'",
                              source_, path_, path_, segment));
    }
    if (*index > array.size()) {
      wrong_input(
          fmt::format("{}: index {} is out of range; '{}' has {} element{} here, and {} would add one",
                      source_, *index, path_, array.size(), array.size() == 1 ? "" : "s", array.size()));
    }
    return *index;
  }

  toml::node* node_;
  std::string path_;
  std::string source_;
};

}  // namespace

Document::Document(std::string_view text, std::string origin, std::span<const std::string> overrides)
    : origin_(std::move(origin)) {
  check_depth(text, origin_);
  try {
    root_ = toml::parse(text, origin_);
  } catch (const toml::parse_error& error) {
    wrong_input(place(error.source()) + std::string(error.description()));
  }
  for (const std::string& override_text : overrides) apply(override_text);
}

void Document::apply(const std::string& override_text) {
  const std::string source = "--set " + override_text;
  const std::size_t equals = override_text.find('=');
  if (equals == std::string::npos || equals == 0) wrong_input(source + ": must be key.path=VALUE");
  const std::size_t begin = override_text.find_first_not_of(' ');
  const std::size_t end = override_text.find_last_not_of(' ', equals - 1);
  const std::vector<std::string> segments =
      segments_of(begin < equals ? override_text.substr(begin, end + 1 - begin) : "", source);
  Setter setter(root_, source);
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    setter.enter(segments[i], index_of(segments[i + 1]) ? "[]" : "{}");
  }
  setter.find(segments.back());  // tells when there is no such place
  if (override_text.find_first_not_of(' ', equals + 1) == std::string::npos) {
    setter.take_away(segments.back());
  } else {
    setter.put(segments.back(), parse_value(override_text.substr(equals + 1), source));
  }
}

std::string Document::place(const toml::source_region& region) const {
  if (region.path && *region.path != origin_) return *region.path + ": ";
  if (region.begin.line == 0) return origin_ + ": ";
  return fmt::format("{}:{}:{}: ", origin_, region.begin.line, region.begin.column);
}

}  // namespace lagomorph::apps
