#pragma once

#include <cstddef>
#include <filesystem>

#include "sim/pin_motion.h"

/// Arrays of the user's that move bodies: .npy, float64, C order. Throws Error(wrong_input) that names the
/// file, its shape and the right one.
namespace lagomorph::apps {

/// A pin's path: displacements (T, 3) of all, or positions (T, vertices, 3). [m]
sim::Recording read_path(const std::filesystem::path&, std::size_t vertices);

/// A velocity for each vertex, (vertices, 3). [m/s]
sim::Points read_velocities(const std::filesystem::path&, Eigen::Index vertices);

}  // namespace lagomorph::apps
