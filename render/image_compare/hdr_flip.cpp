#include "render/image_compare/hdr_flip.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "render/error.h"
#include "render/image_compare/flip.h"
#include "render/image_compare/linear_pair.h"

namespace lagomorph::render {
namespace {

// (k0 x^2 + k1 x) / (k2 x^2 + k3 x + k4)
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03;
constexpr double k2 = 0.6 * 0.6 * 2.43, k3 = 0.6 * 0.59, k4 = 0.14;

/// The light at which the curve reaches t.
double light_at(double t) {
  const double p = (k1 - k3 * t) / (k0 - k2 * t) / 2, q = -k4 * t / (k0 - k2 * t);
  return -p + std::sqrt(p * p - q);
}

/// As numpy's percentile: the mean of the middle two of an even number.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// Both pictures at one exposure, through the curve.
class ExposedPair : public LinearPair {
public:
  ExposedPair(const FloatPicture& a, const FloatPicture& b, double exposure)
      : LinearPair(a.width, a.height), pictures_{&a, &b}, factor_(static_cast<float>(std::exp2(exposure))) {}

  void read(int which, int y, int x, int count, float* red, float* green, float* blue) const override {
    const float* p = at(which, y, x);
    for (int i = 0; i < count; ++i, p += 3) {
      red[i] = shown(p[0]);
      green[i] = shown(p[1]);
      blue[i] = shown(p[2]);
    }
  }
  bool same(int y, int x, int count) const override {
    return std::memcmp(at(0, y, x), at(1, y, x), static_cast<std::size_t>(count) * 3 * sizeof(float)) == 0;
  }

private:
  float shown(float light) const {
    if (std::isinf(light) && light > 0) return 1.0F;
    return light > 0 ? aces(factor_ * light) : 0.0F;  // a NaN is black
  }
  const float* at(int which, int y, int x) const {
    return pictures_[which]->rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * width() + x);
  }

  const FloatPicture* pictures_[2];
  float factor_;
};

/// Values that are not finite are equal where they are of one kind.
bool is_other_kind(float a, float b) {
  if (std::isfinite(a) && std::isfinite(b)) return false;
  return !(std::isnan(a) && std::isnan(b)) && a != b;
}

}  // namespace

float aces(float light) {
  if (light > 1e15F) return 1.0F;  // its square must stay finite
  const double x = std::max(light, 0.0F);
  return static_cast<float>(std::clamp((k0 * x * x + k1 * x) / (k2 * x * x + k3 * x + k4), 0.0, 1.0));
}

ExposureRange exposure_range(const FloatPicture& reference) {
  std::vector<double> luminances;
  for (std::size_t i = 0; i < reference.rgb.size(); i += 3) {
    const float* p = reference.rgb.data() + i;
    const double y = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    if (std::isfinite(y)) luminances.push_back(std::max(y, 0.0));
  }
  const double most = luminances.empty() ? 0 : *std::max_element(luminances.begin(), luminances.end());
  if (most == 0) return {};
  double middle = median(luminances);
  if (middle == 0) {
    std::erase(luminances, 0.0);
    middle = median(luminances);
  }
  const double light = light_at(0.85);
  ExposureRange range{std::log2(light / most), std::log2(light / middle), 2};
  range.count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
  return range;
}

HdrFlip hdr_flip(const FloatPicture& reference, const FloatPicture& test, double pixels_per_degree) {
  if (reference.width != test.width || reference.height != test.height)
    throw SettingsError("pictures of different sizes cannot be compared");
  HdrFlip result{{}, exposure_range(reference)};
  for (int i = 0; i < result.exposures.count; ++i) {
    const ErrorMap map = flip_map(ExposedPair(reference, test, result.exposures.at(i)), pixels_per_degree);
    if (result.map.values.empty())
      result.map = {map.width, map.height, std::vector<float>(map.values.size())};
    for (std::size_t k = 0; k < map.values.size(); ++k)
      result.map.values[k] = std::max(result.map.values[k], map.values[k]);
  }
  for (std::size_t k = 0; k < reference.rgb.size(); ++k) {
    if (is_other_kind(reference.rgb[k], test.rgb[k])) result.map.values[k / 3] = 1.0F;
  }
  return result;
}

}  // namespace lagomorph::render
