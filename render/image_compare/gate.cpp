#include "render/image_compare/gate.h"

#include <array>
#include <charconv>

namespace lagomorph::render {
namespace {

std::string number(double value, int digits = 4) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  return {text.data(), end};
}

/// With as many digits as tell it from the limit.
std::string number_beside(double value, double limit) {
  int digits = 4;
  while (digits < 17 && number(value, digits) == number(limit)) ++digits;
  return number(value, digits);
}

std::string size_text(const PictureKind& kind) {
  return std::to_string(kind.width) + "x" + std::to_string(kind.height);
}

std::string channels_text(int channels) {
  constexpr std::array<const char*, 5> names = {"none", "grey", "grey and alpha", "RGB", "RGB and alpha"};
  return names.at(static_cast<std::size_t>(channels));
}

std::string place(const Tile& tile) {
  return " at " + std::to_string(tile.x) + "," + std::to_string(tile.y) + " (" + std::to_string(tile.width) +
         "x" + std::to_string(tile.height) + " pixels)";
}

void gate_map(const std::string& name, double map_mean, const TileMean& tile, const GateLimits& limits,
              std::vector<GateFailure>& failures) {
  // A NaN fails.
  if (!(tile.mean <= limits.flip_tile_max)) {
    failures.push_back({name + "_tile_max", number_beside(tile.mean, limits.flip_tile_max) + place(tile.tile),
                        number(limits.flip_tile_max)});
  }
  if (!(map_mean <= limits.flip_mean)) {
    failures.push_back({name + "_mean", number_beside(map_mean, limits.flip_mean), number(limits.flip_mean)});
  }
}

}  // namespace

PictureKind kind_of(const Pixels& pixels) {
  return {pixels.width, pixels.height, pixels.bit_depth(), pixels.channels};
}

PictureKind kind_of(const PngHeader& header) {
  return {header.width, header.height, header.bit_depth == 16 ? 16 : 8, header.channels};
}

std::string GateFailure::line() const {
  return rule + " " + found + (limit.empty() ? "" : ", limit " + limit);
}

std::vector<GateFailure> gate_kinds(const PictureKind& a, const PictureKind& b) {
  std::vector<GateFailure> failures;
  const auto differ = [&](const char* rule, const std::string& of_a, const std::string& of_b) {
    if (of_a != of_b) failures.push_back({rule, of_a + " against " + of_b, ""});
  };
  differ("size", size_text(a), size_text(b));
  differ("bit_depth", std::to_string(a.bit_depth), std::to_string(b.bit_depth));
  differ("channels", channels_text(a.channels), channels_text(b.channels));
  return failures;
}

std::vector<GateFailure> gate_figures(const Figures& figures, const GateLimits& limits) {
  std::vector<GateFailure> failures;
  gate_map("flip", figures.flip_mean, figures.flip_tile, limits, failures);
  if (figures.alpha) gate_map("alpha", figures.alpha->mean, figures.alpha->tile, limits, failures);
  return failures;
}

}  // namespace lagomorph::render
