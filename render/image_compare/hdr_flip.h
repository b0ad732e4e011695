#pragma once

#include <vector>

#include "render/image_compare/error_map.h"
#include "render/image_compare/flip_filters.h"

namespace lagomorph::render {

/// Linear light without bounds, rows from the top.
struct FloatPicture {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;  // 3 a pixel
};

/// Exposures in stops, from the one that leaves little of the brightest light saturated to the one that
/// shows the darker half.
struct ExposureRange {
  double start = 0;
  double stop = 0;
  int count = 2;  // evenly spaced, both ends included
  double at(int i) const { return start + (stop - start) * i / (count - 1); }
};

/// The ACES curve as the paper has it, a fit of Narkowicz [2016] with its exposure of 0.6 left out; of light
/// >= 0, clamped to [0, 1].
float aces(float light);

/// Where the curve reaches 0.85 at the reference's largest luminance (start) and at its median (stop)
/// [Andersson et al. 2021, Sec. 4]; one a stop and two at least. A median of 0 gives way to that of the
/// pixels with light. Values that are not finite do not count; 0, 0, 2 where no light is left.
ExposureRange exposure_range(const FloatPicture& reference);

struct HdrFlip {
  ErrorMap map;  // of each pixel the largest LDR-FLIP of all exposures
  ExposureRange exposures;
};

/// HDR-FLIP of two pictures of one size [Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic
/// Range Images"]. A pixel with a value that is not finite in one of them and not the same in the other is 1.
/// The same bits for any number of threads. Throws SettingsError for pictures of different sizes and for a
/// bad `pixels_per_degree`.
HdrFlip hdr_flip(const FloatPicture& reference, const FloatPicture& test,
                 double pixels_per_degree = default_pixels_per_degree);

}  // namespace lagomorph::render
