#pragma once

#include <filesystem>
#include <string>

namespace lagomorph::sim::io {

/// A whole file in memory, with the path as errors name it.
struct File {
  std::string path;
  std::string bytes;
};

/// Throws InputError when there is no such file, it is a directory, or it cannot be read.
File read_file(const std::filesystem::path&);

}  // namespace lagomorph::sim::io
