#pragma once

#include <stdexcept>
#include <string>

namespace lagomorph::sim {

/// Input that cannot be used: a mesh file, a parameter, a selection of vertices. what() is one line that
/// names the file and place (`meshes/a.msh:12: ...`), the value, and what would be right. The program maps it
/// to exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lagomorph::sim
