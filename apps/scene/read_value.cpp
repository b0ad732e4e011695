#include "apps/scene/read_value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/nearest.h"

namespace lagomorph::apps {
namespace {

/// Reads values of every type that a Field has.
class ValueReader {
public:
  explicit ValueReader(const Document& document) : document_(document) {}

  void read(const Key&, const std::string& path, const toml::node& node, bool& value) {
    if (!node.is_boolean()) wrong_type(path, node, "true or false");
    value = node.as_boolean()->get();
  }
  void read(const Key& k, const std::string& path, const toml::node& node, int& value) {
    value = integer<int>(k, path, node);
  }
  void read(const Key& k, const std::string& path, const toml::node& node, std::uint32_t& value) {
    value = integer<std::uint32_t>(k, path, node);
  }
  void read(const Key& k, const std::string& path, const toml::node& node, double& value) {
    value = number(k, path, node);
  }
  void read(const Key& k, const std::string& path, const toml::node& node, float& value) {
    value = static_cast<float>(number(k, path, node));
    // A valid double may be infinite, or on an open bound, as a float.
    if (!std::isfinite(value) || !k.bounds.hold(static_cast<double>(value))) {
      wrong_input(
          fmt::format("{}{} = {} is out of the range of single precision", place(node), path, told(node)));
    }
  }
  void read(const Key& k, const std::string& path, const toml::node& node, std::string& value) {
    value = string(k, path, node);
  }
  template <class T>
  void read(const Key& k, const std::string& path, const toml::node& node, std::optional<T>& value) {
    read(k, path, node, value.emplace());
  }
  /// Vectors and colours.
  template <int n, class Scalar>
  void read_elements(const Key& k, const std::string& path, const toml::node& node, Scalar* values) {
    const toml::array& a = array(path, node, n, "numbers");
    for (int i = 0; i < n; ++i) {
      read(k, fmt::format("{}.{}", path, i), *a.get(static_cast<std::size_t>(i)), values[i]);
    }
  }
  void read(const Key& k, const std::string& path, const toml::node& node, sim::Vec3& value) {
    read_elements<3>(k, path, node, value.data());
  }
  void read(const Key& k, const std::string& path, const toml::node& node, render::Vec2& value) {
    read_elements<2>(k, path, node, value.data());
  }
  void read(const Key& k, const std::string& path, const toml::node& node, render::Vec3& value) {
    read_elements<3>(k, path, node, value.data());
  }
  void read(const Key& k, const std::string& path, const toml::node& node, render::Color& value) {
    read_elements<3>(k, path, node, value.data());
  }
  void read(const Key& k, const std::string& path, const toml::node& node, std::array<double, 2>& value) {
    read_elements<2>(k, path, node, value.data());
  }
  void read(const Key& k, const std::string& path, const toml::node& node, sim::BoxSelector& value) {
    const toml::array& a = array(path, node, 2, "corners, [[x, y, z], [x, y, z]]");
    read(k, path + ".0", *a.get(0), value.min);
    read(k, path + ".1", *a.get(1), value.max);
  }
  void read(const Key& k, const std::string& path, const toml::node& node, std::vector<int>& value) {
    if (k.single && node.is_integer()) {
      value = {integer<int>(k, path, node)};
      return;
    }
    const toml::array& a = array(path, node, -1, "integers");
    value.clear();
    for (std::size_t i = 0; i < a.size(); ++i) {
      value.push_back(integer<int>(k, fmt::format("{}.{}", path, i), *a.get(i)));
    }
  }
  void read(const Key& k, const std::string& path, const toml::node& node, std::vector<std::string>& value) {
    const toml::array& a = array(path, node, -1, "strings");
    value.clear();
    for (std::size_t i = 0; i < a.size(); ++i) {
      value.push_back(string(k, fmt::format("{}.{}", path, i), *a.get(i)));
    }
  }
  /// Points of a curve.
  void read(const Key& k, const std::string& path, const toml::node& node,
            std::vector<std::array<double, 2>>& value) {
    const toml::array& a = array(path, node, -1, "pairs of numbers");
    value.clear();
    for (std::size_t i = 0; i < a.size(); ++i) {
      read_elements<2>(k, fmt::format("{}.{}", path, i), *a.get(i), value.emplace_back().data());
    }
  }
  void read(const Key& k, const std::string& path, const toml::node& node, std::vector<double>& value) {
    const toml::array& a = array(path, node, -1, "numbers");
    value.clear();
    for (std::size_t i = 0; i < a.size(); ++i) {
      value.push_back(number(k, fmt::format("{}.{}", path, i), *a.get(i)));
    }
  }
  void read(const Key& k, const std::string& path, const toml::node& node, std::vector<sim::Vec3>& value) {
    const toml::array& a = array(path, node, -1, "points, [[x, y, z], ...]");
    value.clear();
    for (std::size_t i = 0; i < a.size(); ++i) {
      read_elements<3>(k, fmt::format("{}.{}", path, i), *a.get(i), value.emplace_back().data());
    }
  }

private:
  std::string place(const toml::node& node) const { return document_.place(node.source()); }

  [[noreturn]] void wrong_type(const std::string& path, const toml::node& node, const std::string& expected) {
    wrong_input(fmt::format("{}{} must be {}, not {}", place(node), path, expected, told(node)));
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
    wrong_input(fmt::format("{}{} = {} is out of range; it must be {}", place(node), path, told(node),
                            valid_numbers(k)));
  }

  template <class Int>
  Int integer(const Key& k, const std::string& path, const toml::node& node) {
    const auto* i = node.as_integer();
    if (i == nullptr) wrong_type(path, node, "an integer");
    constexpr auto low = static_cast<std::int64_t>(std::numeric_limits<Int>::min());
    constexpr auto high = static_cast<std::int64_t>(std::numeric_limits<Int>::max());
    Key limited = k;
    if (i->get() < low || i->get() > high) {
      limited.bounds = between(std::max(k.bounds.low, static_cast<double>(low)),
                               std::min(k.bounds.high, static_cast<double>(high)));
    }
    check_range(limited, path, node, static_cast<double>(i->get()));
    return static_cast<Int>(i->get());
  }

  /// `size` elements; any number of them when it is negative.
  const toml::array& array(const std::string& path, const toml::node& node, int size, const std::string& of) {
    const toml::array* a = node.as_array();
    const std::string expected = size < 0 ? "an array of " + of : fmt::format("an array of {} {}", size, of);
    if (a == nullptr) wrong_type(path, node, expected);
    if (size >= 0 && a->size() != static_cast<std::size_t>(size)) {
      wrong_input(fmt::format("{}{} must be {}, not of {}", place(node), path, expected, a->size()));
    }
    return *a;
  }

  std::string string(const Key& k, const std::string& path, const toml::node& node) {
    const auto* s = node.as_string();
    if (s == nullptr) wrong_type(path, node, "a string");
    if (k.choices == nullptr) return s->get();
    const std::vector<std::string> all = k.choices();
    if (std::find(all.begin(), all.end(), s->get()) == all.end()) {
      const std::vector<std::string> shown = shown_choices(k);
      const std::string near = nearest(s->get(), shown);
      wrong_input(fmt::format("{}unknown {} '{}'; {} are {}", place(node), path, s->get(),
                              near.empty() ? "known" : fmt::format("did you mean '{}'? Known", near),
                              joined(shown)));
    }
    return s->get();
  }

  const Document& document_;
};

}  // namespace

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

void read_value(const Document& document, const Key& k, const std::string& path, const toml::node& node,
                Field field) {
  ValueReader reader(document);
  std::visit([&](auto* value) { reader.read(k, path, node, *value); }, field);
}

}  // namespace lagomorph::apps
