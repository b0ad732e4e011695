#include "tests/support/paths.h"

// The only file that is compiled with the paths of a checkout, so that a compiler's cache serves all others
// in every one.
namespace lagomorph::tests {

std::filesystem::path source_dir() { return LAGOMORPH_SOURCE_DIR; }
std::filesystem::path program() { return LAGOMORPH_PROGRAM; }

}  // namespace lagomorph::tests
