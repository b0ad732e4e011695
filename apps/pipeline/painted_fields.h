#pragma once

#include <filesystem>

#include "sim/settings.h"

namespace lagomorph::apps {

/// Reads the values that a field's file paints, if it names one: .npy, float64, one dimension. Throws
/// Error(wrong_input) that names the field's place, the file, its shape and the right one.
void read_painted(const std::filesystem::path& directory, sim::FieldSettings&);

}  // namespace lagomorph::apps
