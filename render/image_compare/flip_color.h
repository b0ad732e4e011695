#pragma once

#include <array>

namespace lagomorph::render {

/// The colour side of FLIP in double: constants for the fast rows, and the plain functions that they are
/// tested against. XYZ are relative to the white of linear RGB (1, 1, 1), D65.
namespace flip {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;  // rows

/// Linear RGB (Rec. 709 primaries) to XYZ / white [IEC 61966-2-1], and back.
const Matrix& relative_xyz_from_rgb();
const Matrix& rgb_from_relative_xyz();
Triple product(const Matrix&, const Triple&);

/// XYZ / white to L*, and a*, b* times 0.01 L* for Hunt's effect [Andersson 2020, Eq. 8].
Triple hunt_lab(const Triple& relative_xyz);
/// |dL| + sqrt(da^2 + db^2) [Abasi 2020].
double hyab(const Triple& lab_1, const Triple& lab_2);

inline constexpr double color_exponent = 0.7;  // q_c
inline constexpr double knee_in = 0.4;         // p_c: share of the largest distance ...
inline constexpr double knee_out = 0.95;       // p_t: ... that is mapped to this share of [0, 1]
/// (HyAB between green and blue)^q_c: the largest there is [Andersson 2020, Sec. 4.1].
double largest_color_distance();
/// A colour difference of two Lab colours in [0, 1].
double color_difference(const Triple& lab_1, const Triple& lab_2);

}  // namespace flip
}  // namespace lagomorph::render
