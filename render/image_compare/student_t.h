#pragma once

namespace lagomorph::render {

/// Probability that |T| >= |t| of Student's t with `dof` > 0 degrees of freedom (not necessarily whole), to
/// some 1e-13 of itself down to 1e-300; 0 under that. 1 for t = 0, 0 for an infinite t.
double two_sided_p(double t, double dof);

}  // namespace lagomorph::render
