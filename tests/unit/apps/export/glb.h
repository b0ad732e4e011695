#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lagomorph::tests {

/// A binary glTF file as its specification has it; what it holds is checked as it is read.
class Glb {
public:
  explicit Glb(const std::string& bytes) {
    if (bytes.size() < 28) throw std::runtime_error("too short for a .glb");
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(bytes, 4), 2U);
    EXPECT_EQ(word(bytes, 8), bytes.size());
    const std::size_t length = word(bytes, 12);
    EXPECT_EQ(length % 4, 0U);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    json = nlohmann::json::parse(bytes.substr(20, length));
    EXPECT_EQ(bytes.substr(24 + length, 4), std::string("BIN\0", 4));
    EXPECT_EQ(word(bytes, 20 + length), bytes.size() - 28 - length);
    bin_ = bytes.substr(28 + length);
    EXPECT_EQ(json["buffers"][0]["byteLength"], bin_.size());
  }

  /// The numbers of an accessor, those of an element one after the other.
  template <class T>
  std::vector<T> values(std::size_t index) const {
    const nlohmann::json& accessor = json["accessors"].at(index);
    const nlohmann::json& view = json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const std::string type = accessor["type"];
    const std::size_t n = type == "VEC4" ? 4 : type == "VEC3" ? 3 : 1, count = accessor["count"];
    EXPECT_EQ(accessor["componentType"], (std::is_same_v<T, float> ? 5126 : 5125));
    const std::size_t offset = view["byteOffset"], size = view["byteLength"], inside = accessor["byteOffset"];
    EXPECT_EQ(offset % 4, 0U);
    EXPECT_EQ(inside % 4, 0U);
    EXPECT_EQ(view.value("byteStride", n * sizeof(T)), n * sizeof(T));
    EXPECT_LE(inside + count * n * sizeof(T), size);
    EXPECT_LE(offset + size, bin_.size());
    std::vector<T> values(count * n);
    std::memcpy(values.data(), bin_.data() + offset + inside, values.size() * sizeof(T));
    if (accessor.contains("min")) expect_bounds(accessor, values, n);
    return values;
  }

  nlohmann::json json;

private:
  static std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t w = 0;
    std::memcpy(&w, bytes.data() + at, sizeof w);
    return w;
  }

  template <class T>
  static void expect_bounds(const nlohmann::json& accessor, const std::vector<T>& values, std::size_t n) {
    std::vector<T> least(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n)), most = least;
    for (std::size_t i = 0; i < values.size(); ++i) {
      least[i % n] = std::min(least[i % n], values[i]);
      most[i % n] = std::max(most[i % n], values[i]);
    }
    EXPECT_EQ(accessor["min"].get<std::vector<T>>(), least);
    EXPECT_EQ(accessor["max"].get<std::vector<T>>(), most);
  }

  std::string bin_;
};

}  // namespace lagomorph::tests
