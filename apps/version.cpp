#include "apps/version.h"

namespace lagomorph::apps {

std::string version() { return LAGOMORPH_VERSION; }

}  // namespace lagomorph::apps
