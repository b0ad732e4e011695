#pragma once

#include <span>
#include <vector>

namespace lagomorph::render {

/// A noisy picture and what guides its smoothing: rows from the top, `width * height` pixels, interleaved.
/// Colours are linear radiance, before exposure.
struct NoisyPicture {
  int width = 0, height = 0;
  std::span<const float> color;     // 3 a pixel, mean of its samples; finite
  std::span<const float> variance;  // 3 a pixel, of that mean; finite, >= 0
  std::span<const float> albedo;    // 3 a pixel, of the surface that is seen, mean of its samples
  std::span<const float> normal;    // 3 a pixel, likewise; 0 where nothing is
  std::span<const float> depth;     // 1 a pixel [m]; +inf where nothing is
};

struct DenoiseSettings {
  int radius = 7;         // of the window that a pixel is found from [pixels], 1 .. 32
  int patch_radius = 2;   // of the squares that are compared [pixels], 0 .. 8
  float strength = 1.0F;  // of noise that two squares may differ by and still be taken for alike, > 0
};

/// The picture without most of its noise, 3 floats a pixel: nonlinearly weighted first-order regression
/// [Bitterli et al. 2016]. Around each pixel the colour is taken to be linear in normal, albedo and depth,
/// fitted to the pixels of a window by weighted least squares and read off in its middle. A pixel of the
/// window weighs by how alike the two pixels' surroundings are, noise apart (non-local means with the
/// variance taken off, [Rousselle et al. 2012]), and by how near their normals, albedos and depths are.
///
/// Where the variance is 0 the picture stays nearly what it is. The number of threads never changes a bit.
/// Throws SettingsError for sizes that do not agree and values out of range.
std::vector<float> denoise(const NoisyPicture&, const DenoiseSettings&);

/// How far from a pixel those are that it is found from. [pixels]
int denoising_reach(const DenoiseSettings&);

}  // namespace lagomorph::render
