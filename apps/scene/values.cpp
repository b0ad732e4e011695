#include "apps/scene/values.h"

#include <fmt/format.h>

namespace lagomorph::apps {
namespace {

std::string text(bool value) { return value ? "true" : "false"; }
std::string text(int value) { return std::to_string(value); }
std::string text(std::uint32_t value) { return std::to_string(value); }
std::string text(const std::string& value) { return toml_string(value); }

/// The shortest decimal that reads back as the same number; always with a point or an exponent, which makes
/// it a TOML float.
template <class Float>
std::string float_text(Float value) {
  const std::string digits = fmt::format("{}", value);
  return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}
std::string text(double value) { return float_text(value); }
std::string text(float value) { return float_text(value); }

std::string text(const std::array<double, 2>& value);
std::string text(const sim::Vec3& value);

template <class Range>
std::string array_text(const Range& values) {
  std::string all;
  for (const auto& value : values) all += (all.empty() ? "" : ", ") + text(value);
  return fmt::format("[{}]", all);
}
std::string text(const sim::Vec3& value) { return array_text(value); }
std::string text(const render::Vec2& value) { return array_text(value); }
std::string text(const render::Vec3& value) { return array_text(value); }
std::string text(const render::Color& value) { return array_text(value); }
std::string text(const std::vector<int>& value) { return array_text(value); }
std::string text(const std::vector<std::string>& value) { return array_text(value); }
std::string text(const std::array<double, 2>& value) { return array_text(value); }
std::string text(const std::vector<std::array<double, 2>>& value) { return array_text(value); }
std::string text(const std::vector<double>& value) { return array_text(value); }
std::string text(const std::vector<sim::Vec3>& value) { return array_text(value); }
std::string text(const sim::BoxSelector& box) {
  return fmt::format("[{}, {}]", text(box.min), text(box.max));
}

struct ValueText {
  template <class T>
  std::optional<std::string> operator()(const T* value) const {
    return text(*value);
  }
  template <class T>
  std::optional<std::string> operator()(const std::optional<T>* value) const {
    if (!*value) return std::nullopt;
    return text(**value);
  }
};

}  // namespace

std::optional<std::string> toml_value(const Field& field) { return std::visit(ValueText(), field); }

std::string toml_string(std::string_view value) {
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

}  // namespace lagomorph::apps
