#pragma once

#include <cstdint>

namespace lagomorph::render::path {

// Names of the sample pairs; those of a surface are counted from surface_dimensions * (its depth + 1).
inline constexpr std::uint32_t pixel_dimension = 0;
inline constexpr std::uint32_t lens_dimension = 1;
inline constexpr std::uint32_t time_dimension = 2;  // u
inline constexpr std::uint32_t surface_dimensions = 16;
inline constexpr std::uint32_t scatter_dimension = 0;
inline constexpr std::uint32_t sky_dimension = 1;
inline constexpr std::uint32_t choice_dimension = 2;   // u: roulette, v: which light
inline constexpr std::uint32_t through_dimension = 3;  // u: ground or what lies behind it
inline constexpr std::uint32_t light_dimension = 4;    // and the three after it
inline constexpr std::uint32_t sun_dimension = 8;
inline constexpr std::uint32_t sun_choice_dimension = 9;  // u
inline constexpr std::uint32_t lobe_dimension = 10;
inline constexpr std::uint32_t clear_dimension = 11;  // of the dielectric's choices
inline constexpr std::uint32_t entry_dimension = 12;  // u: into the cloudy inside or not

constexpr std::uint32_t dimension(std::uint32_t depth, std::uint32_t name) {
  return surface_dimensions * (depth + 1) + name;
}

}  // namespace lagomorph::render::path
