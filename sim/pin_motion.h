#pragma once

#include <string>

#include "sim/motion_curve.h"
#include "sim/settings.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// A recorded path, evenly sampled from t = 0 on.
struct Recording {
  int samples = 0;             // 0: there is none
  int vertices = 0;            // 0: a displacement that all share; else positions of so many vertices
  std::vector<double> values;  // samples × max(vertices, 1) × 3 [m]
};

/// Where the vertices of a driven pin are: the b(t) of q = Pᵀ q_free + b(t), a function of time alone.
class PinMotion {
public:
  /// `X` are the rest positions of the pin's n vertices, n×3. The pin has keys or a recording. Throws
  /// InputError, prefixed by `where`.
  PinMotion(const PinSettings&, const Recording&, const Points& X, const std::string& where);

  Points positions(double t) const;   // n×3 [m]
  Points velocities(double t) const;  // their derivative [m/s]

private:
  enum class Kind { keys, displacement, positions };
  Kind kind_;
  Points X_;
  Vec3 center_;        // of keys
  MotionCurve curve_;  // keys: translation, angles [degrees], scale; recorded: displacement, or positions
};

}  // namespace lagomorph::sim
