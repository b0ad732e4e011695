#pragma once

#include "render/path/path_tracer.h"

namespace lagomorph::render::path {

/// When a square of 8x8 pixels has enough samples.
struct AdaptiveSampling {
  int min_samples;  // a pixel
  int max_samples;  // a pixel
  /// The square is done when the standard error of its pixels, rms over pixels and R, G, B, is no more than
  /// this times the square root of its mean luminance: as the eye and the tone curve see noise.
  double threshold;
};

/// Traces a tile in rounds that double the samples of the squares that are not done: half of min_samples,
/// min_samples, twice as many, ... The variance of a pixel's mean is taken from the difference between what
/// the last round and all before it found. A square's samples are a beginning of those it has without a
/// threshold, whatever its neighbours take. Stopping where the noise happens to look small darkens a picture
/// a little: by far less than the threshold.
///
/// `color` (3 floats a pixel) and `counts` (1, or nullptr) are of the whole picture. `means`, of the same
/// tile, takes every sample; nullptr: none is kept.
void trace_adaptively(PathTracer&, const Tile&, const FrameSamples&, const AdaptiveSampling&,
                      int picture_width, float* color, float* counts, TileMeans* means = nullptr);

}  // namespace lagomorph::render::path
