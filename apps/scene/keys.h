#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "apps/scene/scene_desc.h"

/// The one table of scene keys: visit_scene() shows every key of a scene with where its value stands.
/// Reading, checking, `--set`, writing, hashing and the README's table are visitors of it.
namespace lagomorph::apps {

/// What a key changes.
enum class Part {
  none,        // neither states nor pictures
  simulation,  // the states, and with them the pictures
  picture,     // the pictures alone
};

/// Valid numbers; of an array, of each of its elements.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false;   // low itself is not valid
  bool open_high = false;  // high itself is not valid

  bool hold(double x) const { return (open_low ? x > low : x >= low) && (open_high ? x < high : x <= high); }
  /// "> 0", "in (0, 1)", "in 1 .. 16384"; empty when everything is valid.
  std::string text() const;
};
inline Bounds above(double low) { return {.low = low, .open_low = true}; }
inline Bounds at_least(double low) { return {.low = low}; }
inline Bounds between(double low, double high) { return {.low = low, .high = high}; }
inline Bounds inside(double low, double high) {
  return {.low = low, .high = high, .open_low = true, .open_high = true};
}
inline Bounds above_up_to(double low, double high) { return {.low = low, .high = high, .open_low = true}; }

/// What is said of a key, once.
struct Key {
  const char* name = "";
  const char* unit = "";
  Bounds bounds = {};
  Part part = Part::picture;
  const char* meaning = "";
  std::vector<std::string> (*choices)() = nullptr;  // of a string, or of each in an array of strings
  bool (*holds)(double) = nullptr;                  // what bounds do not say, and
  const char* rule = nullptr;                       // in words
  const char* default_note = nullptr;               // in words, where the default is not a constant
  bool required = false;                            // must be written where its table is
  bool file = false;                                // a path, relative to the scene; empty: none
  bool single = false;                              // of an array: one value alone is read, too
};

/// Bounds and rule in words; empty when every number is valid.
std::string valid_numbers(const Key&);
/// The choices that are told; `null`, the back end that draws nothing, is for tests.
std::vector<std::string> shown_choices(const Key&);

/// A table of keys: `[name]`, one of `[[name]]`, or `name = { ... }`.
struct Table {
  const char* name = "";
  const char* meaning = "";
  bool is_inline = false;  // how it is written; both are read
  bool required = false;   // a scene has at least one
};

/// Where a key's value stands in the description.
using Field =
    std::variant<bool*, int*, std::uint32_t*, double*, float*, std::string*, sim::Vec3*, render::Vec2*,
                 render::Vec3*, render::Color*, std::optional<double>*, std::optional<float>*,
                 std::optional<sim::Vec3>*, std::optional<render::Color>*, std::optional<sim::BoxSelector>*,
                 std::optional<std::array<double, 2>>*, std::vector<int>*, std::vector<std::string>*,
                 std::vector<std::array<double, 2>>*, std::vector<double>*, std::vector<sim::Vec3>*>;

class KeyVisitor;

/// The values of a table in the description: one, none or one, or any number.
struct Elements {
  enum class Kind { one, optional, list };
  Kind kind = Kind::one;
  std::function<int()> size;
  std::function<void(int)> resize;              // new elements have their defaults
  std::function<void(int, KeyVisitor&)> visit;  // shows the keys of an element
};

/// Sees keys and tables in the order in which they are written.
class KeyVisitor {
public:
  virtual ~KeyVisitor() = default;
  virtual void key(const Key&, Field) = 0;
  virtual void table(const Table&, const Elements&) = 0;

  /// A table that is always there.
  template <class T, class Visit>
  void one(const Table& about, T& value, Visit visit) {
    table(about, {Elements::Kind::one, [] { return 1; }, [](int) {},
                  [&value, visit](int, KeyVisitor& v) { visit(value, v); }});
  }
  /// A table that may be there.
  template <class T, class Visit>
  void optional(const Table& about, std::optional<T>& value, Visit visit) {
    const auto resize = [&value](int n) {
      if (n == 0) value.reset();
      if (n == 1 && !value) value.emplace();
    };
    table(about, {Elements::Kind::optional, [&value] { return value ? 1 : 0; }, resize,
                  [&value, visit](int, KeyVisitor& v) { visit(*value, v); }});
  }
  /// An array of tables.
  template <class T, class Visit>
  void list(const Table& about, std::vector<T>& values, Visit visit) {
    table(about, {Elements::Kind::list, [&values] { return static_cast<int>(values.size()); },
                  [&values](int n) { values.resize(static_cast<std::size_t>(n)); },
                  [&values, visit](int i, KeyVisitor& v) { visit(values[static_cast<std::size_t>(i)], v); }});
  }
};

void visit_scene(SceneDesc&, KeyVisitor&);

/// A scene file that says nothing: no body, one light.
SceneDesc default_scene();

}  // namespace lagomorph::apps
