#pragma once

#include <cstddef>
#include <vector>

namespace lagomorph::render {

/// Pixels per degree of a 3840 pixel and 0.7 m wide screen seen from 0.7 m.
inline constexpr double default_pixels_per_degree = 3840.0 * 3.14159265358979323846 / 180.0;
inline constexpr double least_pixels_per_degree = 1.0;
inline constexpr double most_pixels_per_degree = 1000.0;

/// Half of an even filter: weights of the offsets 0, 1, 2, ...
using EvenFilter = std::vector<float>;

/// The one-dimensional filters that FLIP's two-dimensional ones are products or sums of products of
/// [Andersson 2020, Secs. 4.1 and 4.2]. Pixel offsets; the borders are the filters' radii.
struct FlipFilters {
  // Contrast sensitivity: the luminance, red-green and the two parts of the blue-yellow channel.
  EvenFilter y;
  EvenFilter cx;
  EvenFilter cz_1;
  EvenFilter cz_2;
  // Features: a Gaussian, its first derivative (the weights of +k; those of -k are their negatives) and its
  // second. Positive weights of a derivative sum to 1, negative ones to -1. The second's weight of 0 is minus
  // the sum of the others, and is applied as such: in a flat region the derivatives are exactly zero.
  EvenFilter gauss;
  EvenFilter first;
  EvenFilter second;

  /// The largest radius: what a region needs around itself. [pixels]
  std::size_t halo() const;
};

/// Throws SettingsError outside [least_pixels_per_degree, most_pixels_per_degree].
void check_pixels_per_degree(double);
FlipFilters flip_filters(double pixels_per_degree);

}  // namespace lagomorph::render
