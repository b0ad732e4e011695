#include "apps/scene/render_keys.h"

#include <bit>

#include "apps/run/channel_files.h"
#include "render/color.h"
#include "render/path/filter.h"
#include "render/renderer.h"

namespace lagomorph::apps {
namespace {

void visit_raster(render::RasterSettings& r, KeyVisitor& v) {
  v.key({.name = "multisample",
         .meaning = "samples a pixel of the rasterizer",
         .holds = [](double n) { return n == 1 || n == 4; },
         .rule = "1 or 4"},
        &r.multisample);
  v.key({.name = "supersample",
         .bounds = between(1, 4),
         .meaning =
             "pictures are drawn so many times as wide and high, then reduced: highlights and textures are "
             "smooth as well as edges"},
        &r.supersample);
  v.key({.name = "rays",
         .meaning = "clear bodies, mirrors, coats and smooth grounds show what rays see in them; false: a "
                    "quicker picture without"},
        &r.rays);
  v.key({.name = "shadow_map",
         .unit = "pixels",
         .bounds = between(256, 8192),
         .meaning = "along a side",
         .holds = [](double n) { return std::has_single_bit(static_cast<unsigned>(n)); },
         .rule = "a power of two"},
        &r.shadow_map);
  v.key({.name = "shadow_samples", .bounds = between(1, 64), .meaning = "taps of the soft shadow filter"},
        &r.shadow_samples);
}

void visit_path(render::PathSettings& p, KeyVisitor& v) {
  v.key({.name = "bounces", .bounds = between(0, 64), .meaning = "indirect bounces after the first hit"},
        &p.bounces);
  v.key({.name = "transmission_bounces",
         .bounds = between(0, 256),
         .meaning = "further ones through or off the inside of clear bodies"},
        &p.transmission_bounces);
  v.key({.name = "clamp",
         .unit = "W/(sr m^2)",
         .bounds = at_least(0),
         .meaning = "most that a path brings of indirect light, against fireflies; 0: all of it"},
        &p.clamp);
  v.key({.name = "seed", .meaning = "of the sample sequence"}, &p.seed);
  v.key({.name = "filter", .meaning = "pixel reconstruction", .choices = render::path::filter_names},
        &p.filter);
  v.key({.name = "filter_radius",
         .unit = "pixels",
         .bounds = above_up_to(0, 4),
         .meaning = "of the reconstruction filter"},
        &p.filter_radius);
  v.key({.name = "noise_threshold",
         .bounds = at_least(0),
         .meaning =
             "adaptive sampling: squares of 8x8 pixels get no more samples once their noise (standard error "
             "over "
             "the square root of the luminance) is below this; 0.01 is usual, 0: all get render.samples"},
        &p.noise_threshold);
  v.key({.name = "min_samples", .bounds = between(1, 65536), .meaning = "of adaptive sampling, a pixel"},
        &p.min_samples);
  v.key(
      {.name = "denoise",
       .meaning = "smooths the noise away, guided by normal, albedo, depth and variance; needs 2 samples or "
                  "more. Not for goldens: what is left of the noise is no longer that of each pixel alone"},
      &p.denoise);
}

}  // namespace

void visit_render(render::RenderSettings& r, KeyVisitor& v) {
  v.key({.name = "backend", .meaning = "who draws", .choices = render::renderer_names}, &r.backend);
  v.key({.name = "width", .unit = "pixels", .bounds = between(1, 16384), .meaning = "of the picture"},
        &r.width);
  v.key({.name = "height", .unit = "pixels", .bounds = between(1, 16384), .meaning = "of the picture"},
        &r.height);
  v.key({.name = "samples", .bounds = between(1, 65536), .meaning = "paths a pixel (path only)"}, &r.samples);
  v.key({.name = "tone_curve",
         .meaning = "from linear light to the display",
         .choices = render::tone_curve_names},
        &r.tone_curve);
  v.key(
      {.name = "exposure", .unit = "stops", .meaning = "linear light times 2^exposure before the tone curve"},
      &r.exposure);
  v.key({.name = "dither",
         .unit = "8-bit steps",
         .bounds = between(0, 2),
         .meaning =
             "pictures are rounded to 8 bits under a fine fixed pattern of this height, against bands in "
             "smooth gradients; 1 hides them all, 0: none"},
        &r.dither);
  v.key({.name = "png_compression", .bounds = between(0, 12), .meaning = "zlib level of the pictures"},
        &r.png_compression);
  v.key({.name = "channels",
         .meaning = "written beside the picture, to RUN/aov/NAME/",
         .choices = render::channel_names},
        &r.channels);
  v.key({.name = "channel_format",
         .meaning =
             "of their files: NumPy arrays, OpenEXR, one OpenEXR for the picture and all of them, or 16-bit "
             "PNG of those that fit",
         .choices = channel_formats},
        &r.channel_format);
  v.key({.name = "transparent",
         .meaning = "nothing is seen where nothing is: pictures have an alpha channel, of which the ground's "
                    "fading edge takes its part"},
        &r.transparent);
  v.key(
      {.name = "region",
       .unit = "pixels",
       .bounds = at_least(0),
       .meaning = "[x0, y0, x1, y1]: only these pixels, from the top left corner, without column x1 and row "
                  "y1; pictures have their size; empty: all"},
      &r.region);
  v.one({.name = "raster", .meaning = "of the raster back end"}, r.raster, visit_raster);
  v.one({.name = "path", .meaning = "of the path back end"}, r.path, visit_path);
}

}  // namespace lagomorph::apps
