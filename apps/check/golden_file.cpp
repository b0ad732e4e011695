#include "apps/check/golden_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/cli/command_line.h"
#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/nearest.h"
#include "apps/scene/document.h"
#include "apps/scene/read_value.h"
#include "render/image_compare/flip_filters.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

namespace {

constexpr char override_place[] = "--set ";

std::vector<std::string> extra_choices() { return {"fail", "ignore"}; }

/// Writes "golden.toml:3:1: " as "golden.toml:3:1".
std::string who(std::string place) {
  while (!place.empty() && (place.back() == ' ' || place.back() == ':')) place.pop_back();
  return place;
}

}  // namespace

class GoldenReader {
public:
  GoldenReader(const Document& document, fs::path folder, std::optional<std::string> preset)
      : document_(document), folder_(std::move(folder)), preset_(std::move(preset)) {}

  GoldenFile read() {
    const toml::table& root = document_.root();
    check_names(
        root,
        {"preset", "pixels_per_degree", "extra", "keep_every", "states_every", "limits", "range", "mask"},
        "at the top");
    golden_.pixels_per_degree = render::default_pixels_per_degree;
    GoldenFile::Rules base;
    base.preset = {default_preset, "the default"};
    if (preset_) base.preset = {*preset_, "--preset"};
    rules_of(root, base, "");
    golden_.rules_.push_back(std::move(base));
    read_key(root,
             {.name = "pixels_per_degree",
              .bounds = between(render::least_pixels_per_degree, render::most_pixels_per_degree)},
             "", &golden_.pixels_per_degree);
    std::string extra = "fail";
    read_key(root, {.name = "extra", .choices = extra_choices}, "", &extra);
    golden_.ignore_extra = extra == "ignore";
    read_key(root, {.name = "keep_every", .bounds = at_least(1)}, "", &golden_.keep_every);
    read_key(root, {.name = "states_every", .bounds = at_least(0)}, "", &golden_.states_every);
    each(root, "range", [&](const toml::table& t, const std::string& path) { read_range(t, path); });
    each(root, "mask", [&](const toml::table& t, const std::string& path) { read_mask(t, path); });
    golden_.rules_.push_back(std::move(strongest_));
    return std::move(golden_);
  }

private:
  bool read_key(const toml::table& table, const Key& key, const std::string& path, Field field) {
    const toml::node* node = table.get(key.name);
    if (node == nullptr) return false;
    read_value(document_, key, path + key.name, *node, field);
    return true;
  }

  void check_names(const toml::table& table, const std::vector<std::string>& known,
                   const std::string& where) const {
    for (const auto& [key, node] : table) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      const std::string near = nearest(key.str(), known);
      wrong_input(fmt::format("{}unknown key '{}'; {}", document_.place(key.source()), key.str(),
                              near.empty() ? fmt::format("known {} are {}", where, joined(known))
                                           : fmt::format("did you mean '{}'?", near)));
    }
  }

  [[noreturn]] void wrong(const toml::node& node, const std::string& path,
                          const std::string& expected) const {
    wrong_input(
        fmt::format("{}{} must be {}, not {}", document_.place(node.source()), path, expected, told(node)));
  }

  template <class Visit>
  void each(const toml::table& root, const char* name, const Visit& visit) {
    const toml::node* node = root.get(name);
    if (node == nullptr) return;
    const toml::array* array = node->as_array();
    if (array == nullptr) wrong(*node, name, fmt::format("an array of tables, [[{}]]", name));
    for (std::size_t i = 0; i < array->size(); ++i) {
      const std::string path = fmt::format("{}.{}", name, i);
      const toml::table* table = array->get(i)->as_table();
      if (table == nullptr) wrong(*array->get(i), path, "a table");
      visit(*table, path + ".");
    }
  }

  /// `preset` and `limits` of a table.
  void rules_of(const toml::table& table, GoldenFile::Rules& rules, const std::string& path) {
    if (const toml::node* node = table.get("preset")) {
      std::string preset;
      read_key(table, {.name = "preset", .choices = preset_names}, path, &preset);
      if (!preset_) rules.preset = {preset, who(document_.place(node->source()))};
    }
    const toml::node* node = table.get("limits");
    if (node == nullptr) return;
    const toml::table* limits = node->as_table();
    if (limits == nullptr) wrong(*node, path + "limits", "a table");
    check_names(*limits, limit_names(), fmt::format("in [{}limits]", path));
    for (std::size_t i = 0; i < limit_count; ++i) {
      const toml::node* value = limits->get(limit_rows()[i].name);
      if (value != nullptr) read_limit(static_cast<LimitName>(i), *value, *limits, path + "limits.", rules);
    }
  }

  void read_limit(LimitName name, const toml::node& node, const toml::table& table, const std::string& path,
                  GoldenFile::Rules& rules) {
    const LimitRow& row = limit_row(name);
    LimitValue limit{.value = std::nullopt, .from = who(document_.place(node.source()))};
    const auto* text = node.as_string();
    if (text == nullptr || text->get() != "off") {
      if (text != nullptr) wrong(node, path + row.name, "a number or \"off\"");
      double value = 0;
      read_key(table, {.name = row.name, .bounds = between(row.low, row.high)}, path, &value);
      limit.value = value;
    }
    const bool from_command_line = limit.from.starts_with(override_place);
    if (from_command_line) {
      strongest_.limits.emplace_back(name, limit);
    } else if (!preset_) {
      rules.limits.emplace_back(name, limit);
    }
  }

  std::optional<FrameRange> frames_of(const toml::table& table, const std::string& path) const {
    const toml::node* node = table.get("frames");
    if (node == nullptr) return std::nullopt;
    const std::string what = fmt::format("{}{}frames = ", document_.place(node->source()), path);
    if (const auto* text = node->as_string()) return parse_frames(text->get(), what);
    if (const auto* number = node->as_integer()) return parse_frames(std::to_string(number->get()), what);
    wrong(*node, path + "frames", "\"A..B\" or one number");
  }

  void read_range(const toml::table& table, const std::string& path) {
    check_names(table, {"frames", "preset", "limits"}, "in [[range]]");
    const std::optional<FrameRange> frames = frames_of(table, path);
    if (!frames)
      wrong_input(fmt::format("{}{}frames is missing: \"A..B\" or one number",
                              document_.place(table.source()), path));
    GoldenFile::Rules rules;
    rules.frames = *frames;
    rules_of(table, rules, path);
    golden_.rules_.push_back(std::move(rules));
  }

  void read_mask(const toml::table& table, const std::string& path) {
    check_names(table, {"frames", "png", "rectangle", "body_id"}, "in [[mask]]");
    MaskRule mask;
    mask.frames = frames_of(table, path);
    mask.from = who(document_.place(table.source()));
    std::string png;
    const bool has_png = read_key(table, {.name = "png"}, path, &png);
    std::vector<int> corners;
    const bool has_rectangle =
        read_key(table, {.name = "rectangle", .bounds = between(0, 1 << 24)}, path, &corners);
    int body_id = 0;
    const bool has_id = read_key(table, {.name = "body_id", .bounds = between(-1, 1 << 24)}, path, &body_id);
    if (has_id) mask.body_id = body_id;
    if (int{has_png} + int{has_rectangle} + int{has_id} != 1 || (has_png && png.empty())) {
      wrong_input(fmt::format("{}: {} must have either png, rectangle or body_id", mask.from,
                              path.substr(0, path.size() - 1)));
    }
    if (has_png) mask.png = folder_ / png;
    if (has_rectangle) {
      if (corners.size() != 4)
        wrong(*table.get("rectangle"), path + "rectangle", "[x, y, width, height] in pixels");
      mask.rectangle = {corners[0], corners[1], corners[2], corners[3]};
    }
    golden_.masks.push_back(std::move(mask));
  }

  const Document& document_;
  fs::path folder_;
  std::optional<std::string> preset_;
  GoldenFile golden_;
  GoldenFile::Rules strongest_;  // of the command line
};

Limits GoldenFile::limits(int frame) const {
  Limits limits;
  for (const Rules& rules : rules_) {
    if (frame < rules.frames.first || frame > rules.frames.last) continue;
    if (rules.preset) limits = preset_limits(rules.preset->first, rules.preset->second);
    for (const auto& [name, limit] : rules.limits) limits[name] = limit;
  }
  return limits;
}

std::string GoldenFile::preset(int frame) const {
  std::string preset;
  for (const Rules& rules : rules_) {
    if (rules.preset && rules.frames.first <= frame && frame <= rules.frames.last)
      preset = rules.preset->first;
  }
  return preset;
}

GoldenFile read_golden_file(const fs::path& golden, std::span<const std::string> overrides,
                            const std::optional<std::string>& preset) {
  const fs::path file = golden / "golden.toml";
  std::error_code none;
  const std::string text = fs::exists(file, none) ? read_file(file) : std::string();
  const Document document(text, file.string(), overrides);
  return GoldenReader(document, golden, preset).read();
}

}  // namespace lagomorph::apps
