#pragma once

namespace lagomorph::apps {

/// SHA-256 of the libraries that this program was linked from; made by build_id.cmake.
struct BuildId {
  const char* simulation;  // lagomorph_sim: what decides a state
  const char* program;     // all of it: what decides a picture
};
extern const BuildId build_id;

}  // namespace lagomorph::apps
