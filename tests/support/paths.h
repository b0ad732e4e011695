#pragma once

#include <filesystem>

namespace lagomorph::tests {

/// The root of this checkout.
std::filesystem::path source_dir();
/// The built `lagomorph`.
std::filesystem::path program();

}  // namespace lagomorph::tests
