#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/camera.h"
#include "render/channels.h"
#include "render/image.h"
#include "render/render_scene.h"
#include "render/settings.h"

namespace lagomorph::render {

/// What a frame is, for seeds and names; pixels depend on nothing else but scene, positions, camera and
/// settings.
struct FrameInfo {
  int frame = 0;
  double time = 0.0;  // [s]
  const Camera* camera_before =
      nullptr;  // of the frame before, for motion vectors; nullptr: it has not moved
  std::span<const Camera> shutter_cameras = {};  // see camera_at(), the frame's last; none: it stands still
  bool leaves_out_ground = false;                // the scene's, where it has some
  std::optional<PixelRegion> region = {};        // the other pixels may be anything; none: all are drawn
};

/// A back end. Not for use by two threads at once; a renderer is used by the thread that made it.
class Renderer {
public:
  virtual ~Renderer() = default;
  virtual std::string_view name() const = 0;
  /// Takes the scene: geometry, materials, lights. Throws SettingsError or DeviceError.
  virtual void set_scene(const RenderScene&) = 0;
  /// New positions of scene.meshes[mesh], as many as it has [m]. Topology stays.
  virtual void update_positions(int mesh, std::span<const Vec3> positions) = 0;
  /// New colours of scene.meshes[mesh], which has some: one for each vertex, in [0, 1]. Throws SettingsError.
  virtual void update_colors(int mesh, std::span<const Color> colors) = 0;
  /// Where a mesh is while the shutter is open [m]: at scene.motion_segments equidistant times from when it
  /// opens, all but the last, when it is at its positions. It goes straight between them, and stands still
  /// after an update of its positions. Back ends that draw no motion blur ignore it. Throws SettingsError for
  /// another number of times or positions.
  virtual void set_motion(int /*mesh*/, std::span<const std::vector<Vec3>> /*positions*/) {}
  /// Whether set_motion() and FrameInfo::shutter_cameras have an effect.
  virtual bool draws_motion_blur() const { return false; }
  /// Where a mesh was at the frame before, for motion vectors; after an update of its positions it stands
  /// still.
  virtual void set_previous(int /*mesh*/, std::span<const Vec3> /*positions*/) {}
  /// Draws "color" (linear) and every channel of settings.channels. The camera's size is the picture's.
  virtual Image render(const Camera&, const FrameInfo&) = 0;
  /// What render() has taken so far to read what was drawn from the device to memory [s]; 0 where there is
  /// none.
  virtual double seconds_reading_back() const { return 0.0; }
  /// Library versions, device, instruction set: what the pixels' bits depend on. For run.json.
  virtual std::string description() const = 0;
};

std::vector<std::string> renderer_names();  // raster, path, null
/// `threads` bounds the back end's threads and never changes a pixel. Throws SettingsError for an unknown
/// backend or channel (listing the valid ones) and for values out of range, DeviceError when the machine
/// cannot.
std::unique_ptr<Renderer> make_renderer(const RenderSettings&, int threads);

/// What the settings' back end draws otherwise than they and the scene say, a line each.
std::vector<std::string> renderer_remarks(const RenderSettings&, const CameraSettings&, const RenderScene&);

}  // namespace lagomorph::render
