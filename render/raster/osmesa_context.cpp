#include <array>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include <GL/osmesa.h>

#include "render/error.h"
#include "render/raster/gl.h"
#include "render/raster/gl_context.h"

namespace lagomorph::render::raster {
namespace {

class OsmesaContext final : public GlContext {
public:
  OsmesaContext() {
    const std::array<int, 13> attributes = {OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_DEPTH_BITS,
                                            0,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            4,
                                            OSMESA_CONTEXT_MINOR_VERSION,
                                            5,
                                            0,
                                            0,
                                            0};
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (!context_)
      throw DeviceError("OSMesa gives no OpenGL 4.5 core context; is libosmesa6 with llvmpipe installed?");
    try {
      make_current();
    } catch (...) {
      OSMesaDestroyContext(context_);
      throw;
    }
  }
  ~OsmesaContext() override {
    if (OSMesaGetCurrentContext() == context_) OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(context_);
  }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  void make_current() override {
    if (OSMesaGetCurrentContext() == context_) return;
    if (!OSMesaMakeCurrent(context_, surface_.data(), GL_UNSIGNED_BYTE, surface_side, surface_side))
      throw DeviceError("OSMesa cannot make its OpenGL context current");
  }
  std::string platform() const override { return "OSMesa"; }

private:
  static constexpr int surface_side = 4;  // never drawn to
  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * surface_side * surface_side> surface_{};
};

/// What the software rasterizer reads from the environment when its first context is made.
void set_environment(int threads) {
  // An existing value is the user's and stays.
  setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
  const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width && std::strcmp(width, "512") == 0)
    throw DeviceError("LP_NATIVE_VECTOR_WIDTH=512 crashes llvmpipe with multisampling; unset it or use 256");
}

}  // namespace

std::unique_ptr<GlContext> make_gl_context(int threads) {
  static std::mutex mutex;  // over the environment and OSMesa's own first-time set-up
  const std::lock_guard lock(mutex);
  set_environment(threads);
  return std::make_unique<OsmesaContext>();
}

}  // namespace lagomorph::render::raster
