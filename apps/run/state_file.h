#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "sim/model.h"

namespace lagomorph::apps {

/// The file of a state: float64, C order, shape (levels, 2, V, 3): levels newest first, then positions [m]
/// and velocities [m/s].
std::string encode_state(const sim::State&);

/// The state of a file's bytes. `origin` names the file. `history_times` are those of the record's levels,
/// newest first; a level without one has NaN. Throws Error(wrong_input) for anything but a finite state of
/// `vertices` vertices.
sim::State decode_state(std::string_view bytes, const std::string& origin, int frame, double fps,
                        int vertices, std::span<const double> history_times = {});

/// The same of a file.
sim::State read_state(const std::filesystem::path&, int frame, double fps, int vertices,
                      std::span<const double> history_times = {});

/// Size of such a file. [bytes]
std::size_t state_file_size(int vertices, int levels);

}  // namespace lagomorph::apps
