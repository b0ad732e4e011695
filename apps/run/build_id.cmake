# cmake -DOUTPUT=build_id.cpp -DSIM=... -DRENDER=... -DAPP=... -P build_id.cmake
# Writes the hashes of the archives as a source file. Archives are deterministic, so the same sources built by the
# same compiler have the same hash wherever they are built.
foreach(name SIM RENDER APP)
  file(SHA256 "${${name}}" hash_${name})
endforeach()
string(SHA256 program "${hash_SIM} ${hash_RENDER} ${hash_APP}")
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT [[
#include "apps/run/build_id.h"

namespace lagomorph::apps {

const BuildId build_id = {"@hash_SIM@", "@program@"};

}  // namespace lagomorph::apps
]] @ONLY)
