#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lagomorph::render {

/// Only the rasterizer reads these.
struct RasterSettings {
  int multisample = 4;      // 1 or 4 (llvmpipe's most)
  int supersample = 1;      // the picture is drawn so many times as wide and high, 1 .. 4
  bool rays = true;         // glass, mirrors and smooth grounds show what rays see in them
  int shadow_map = 2048;    // pixels along a side, a power of two in 256 .. 8192
  int shadow_samples = 32;  // taps of the soft shadow filter, 1 .. 64
};

/// Only the path tracer reads these, but `samples`.
struct PathSettings {
  int bounces = 4;                         // indirect bounces after the first hit, 0 .. 64
  int transmission_bounces = 8;            // through or off clear insides, not counted in bounces, 0 .. 256
  float clamp = 0.0F;                      // most that a path brings of indirect light [W/(sr m^2)]; 0: any
  std::uint32_t seed = 0;                  // of the sample sequence
  std::string filter = "blackman_harris";  // pixel reconstruction: box, gaussian, blackman_harris
  float filter_radius = 1.5F;              // [pixels], in (0, 4]
  float noise_threshold = 0.0F;  // of adaptive sampling, see path/adaptive.h; 0: every pixel takes `samples`
  int min_samples = 16;          // of adaptive sampling, a pixel, 1 .. 65536
  bool denoise = false;          // the picture, see denoise.h; needs 2 samples or more
};

/// Pixels x0 <= x < x1, y0 <= y < y1, from the top left corner.
struct PixelRegion {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

struct RenderSettings {
  std::string backend = "raster";          // see renderer_names()
  int width = 1280;                        // [pixels], 1 .. 16384
  int height = 720;                        // likewise
  int samples = 64;                        // paths a pixel (path only), 1 .. 65536
  std::string tone_curve = "pbr_neutral";  // see tone_curve_names()
  float exposure = 0.0F;                   // stops: linear light times 2^exposure before the curve
  float dither = 0.0F;                     // of 8-bit pictures [8-bit steps], 0 .. 2: see tone_map()
  int png_compression = 1;                 // zlib level, 0 .. 12 (libdeflate's)
  std::vector<std::string> channels;       // written beside the picture: see channel_kinds()
  std::string channel_format = "npy";      // of their files; only told to the renderer
  bool transparent = false;  // nothing is seen where nothing is: colour over black, and the channel alpha
  std::vector<int> region;   // x0, y0, x1, y1 [pixels], see FrameInfo::region; empty: all
  RasterSettings raster;
  PathSettings path;

  /// What is asked for of the picture.
  PixelRegion drawn() const {
    if (region.empty()) return {0, 0, width, height};
    return {region[0], region[1], region[2], region[3]};
  }
};

}  // namespace lagomorph::render
