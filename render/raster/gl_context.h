#pragma once

#include <memory>
#include <string>

/// The one place that knows where a GL context comes from. All drawing goes into framebuffer objects, so a
/// context needs no window and no surface of a useful size.
namespace lagomorph::render::raster {

class GlContext {
public:
  virtual ~GlContext() = default;
  /// Binds the context to the calling thread. Throws DeviceError.
  virtual void make_current() = 0;
  /// "OSMesa", "EGL surfaceless", ...
  virtual std::string platform() const = 0;
};

/// A core profile 4.5 context, current on this thread. `threads` bounds the software rasterizer's threads
/// unless the user did (LP_NUM_THREADS); Mesa reads it once a process, at the first context. Throws
/// DeviceError.
std::unique_ptr<GlContext> make_gl_context(int threads);

}  // namespace lagomorph::render::raster
