#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "sim/pin_motion.h"
#include "sim/pins.h"
#include "sim/types.h"

namespace lagomorph::sim {

/// What one pin of the scene holds.
struct Hold {
  std::vector<int> vertices;  // of the mesh of all, ascending
  Axes axes = kAllAxes;
  std::shared_ptr<const PinMotion> motion;                   // none: where they are at the start
  double release = std::numeric_limits<double>::infinity();  // from then on they are free [s]
};

/// What holds the bodies during a step: P, and the b(t) of the coordinates that are driven.
class Held {
public:
  /// Those of the scene's pins that hold at t. A coordinate that several hold is the first one's; one that is
  /// driven must have no other (see check_holds).
  Held(int vertex_count, const std::vector<Hold>&, double t);

  const Pins& pins() const { return pins_; }
  bool is_driven() const { return !driven_.empty(); }
  void place(double t, VecX& q) const;              // q = b(t) where driven, in place
  void set_velocities(double t, VecX& qdot) const;  // q̇ = ḃ(t) where driven, in place
  /// Of the force on each coordinate, 3n, what each pin of the scene exerts in all; zero of released ones.
  /// [N]
  std::vector<Vec3> forces(const VecX& balance) const;

private:
  template <class Value>
  void write(const Value& value, VecX& full) const;

  Pins pins_;
  std::vector<Hold> driven_;
  std::vector<std::vector<int>> dofs_;  // of each pin of the scene
};

/// Throws InputError when a driven coordinate has two holders. `names` are the pins', as messages name them.
void check_holds(int vertex_count, const std::vector<Hold>&, const std::vector<std::string>& names);

}  // namespace lagomorph::sim
