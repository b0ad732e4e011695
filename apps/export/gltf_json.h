#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/export/moving_mesh.h"

namespace lagomorph::apps {

/// Where the data stand in the binary chunk: triangles of all bodies, the animation (times, weights, and of a
/// camera that moves positions and rotations), then a frame after the other the positions and normals of each
/// body, then the colours of the bodies that have some. [bytes]
class GltfLayout {
public:
  GltfLayout(const std::vector<MovingMesh>&, int frames, bool camera_moves);

  std::uint64_t index_bytes() const { return index_bytes_; }
  std::uint64_t time_bytes() const { return time_bytes_; }
  std::uint64_t weight_bytes() const { return weight_bytes_; }
  std::uint64_t animation_bytes() const { return time_bytes_ + weight_bytes_ + camera_bytes_; }
  std::uint64_t frame_bytes() const { return frame_bytes_; }
  std::uint64_t color_bytes() const { return color_bytes_; }
  std::uint64_t colors_at() const { return frames_at() + static_cast<std::uint64_t>(frames_) * frame_bytes_; }
  std::uint64_t size() const { return colors_at() + color_bytes_; }
  std::uint64_t frames_at() const { return index_bytes_ + animation_bytes(); }
  int frames() const { return frames_; }

private:
  int frames_;
  std::uint64_t index_bytes_ = 0, time_bytes_ = 0, weight_bytes_ = 0, camera_bytes_ = 0, frame_bytes_ = 0,
                color_bytes_ = 0;
};

/// Time of the k-th frame of the file. [s]
inline float gltf_time(int k, double fps) { return static_cast<float>(k / fps); }

/// The JSON chunk. `extents`: of each body's positions, a frame, those after the first less the first's.
std::string gltf_json(const ExportedSequence&, const std::vector<MovingMesh>&, const GltfLayout&,
                      const std::vector<std::vector<Extent>>& extents);

}  // namespace lagomorph::apps
