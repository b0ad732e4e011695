#include "sim/start.h"

#include <cstdint>

#include "sim/error.h"

namespace lagomorph::sim {

namespace {

/// In [0, 1), a function of its arguments. [Steele, Lea and Flood 2014, "Fast splittable pseudorandom number
/// generators"]
double random(int seed, int vertex, int axis) {
  std::uint64_t z = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(seed)) << 32) +
                    3 * static_cast<std::uint64_t>(vertex) + static_cast<std::uint64_t>(axis) + 1;
  for (int round = 0; round < 2; ++round) {
    z += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    z ^= z >> 31;
  }
  return static_cast<double>(z >> 11) / 9007199254740992.0;
}

}  // namespace

std::vector<std::string> start_names() { return {"rest", "scramble", "flatten"}; }

void set_start(const BodySettings& body, const Range& vertices, const Points& X, const Pins& pins,
               const std::string& where, VecX& q) {
  if (body.start == "rest") return;
  if (body.start != "scramble" && body.start != "flatten")
    throw InputError(where + ": unknown start '" + body.start + "'; valid ones are rest, scramble, flatten");
  const auto of_body = X.middleRows(vertices.begin, vertices.size());
  const Vec3 low = of_body.colwise().minCoeff().transpose(), high = of_body.colwise().maxCoeff().transpose();
  for (int v = vertices.begin; v < vertices.end; ++v) {
    for (int k = 0; k < 3; ++k) {
      if (pins.is_held(3 * v + k)) continue;
      if (body.start == "flatten") {
        if (k == 1) q[3 * v + k] = 0.5 * (low.y() + high.y());
      } else {
        q[3 * v + k] = low[k] + (high[k] - low[k]) * random(body.seed, v - vertices.begin, k);
      }
    }
  }
}

}  // namespace lagomorph::sim
