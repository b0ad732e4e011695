#pragma once

/// When the shutter of a frame is open: the times at which what moves is asked where it is.
namespace lagomorph::apps {

/// Straight pieces that a way is drawn in while the shutter is open. Of an arc they leave 1/64 of what one
/// would: of half a radian in 300 pixels from its middle 0.15 pixels instead of 9.
inline constexpr int motion_segments = 8;

/// How long before the frame a time step of its shutter is, from 0, when it opens, to motion_segments, the
/// frame itself; `shutter` is the part of the time between frames that it is open. [frames]
constexpr double frames_to_go(int step, double shutter) {
  return shutter * static_cast<double>(motion_segments - step) / motion_segments;
}

}  // namespace lagomorph::apps
