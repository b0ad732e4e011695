#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lagomorph::render {

using Vec2 = Eigen::Vector2f;
using Vec3 = Eigen::Vector3f;
using Mat4 = Eigen::Matrix4f;
using Color = Eigen::Array3f;  // linear Rec. 709 / sRGB primaries; multiplies component by component
using Triangle = std::array<std::uint32_t, 3>;

}  // namespace lagomorph::render
