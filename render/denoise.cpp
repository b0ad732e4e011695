#include "render/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "render/error.h"

namespace lagomorph::render {
namespace {

constexpr int features = 7;  // normal, albedo, depth
constexpr int unknowns = 1 + features;
constexpr int block_rows = 8;         // found together
constexpr float normal_scale = 0.5F;  // of a feature, in which it counts as another surface
constexpr float albedo_scale = 0.5F;
constexpr float depth_scale = 0.1F;        // of its logarithm
constexpr float nowhere = 1e6F;            // depth of where nothing is [m]
constexpr float ridge = 0.01F;             // keeps features that hardly vary from fitting the noise
constexpr float residual_share = 0.2F;     // of the variance, left after the first pass
constexpr float just_noticeable = 0.002F;  // of luminance: below it squares are alike without noise, too

using Floats = std::vector<float>;

/// A plane of floats with a border, where it goes on as at its edge.
class Plane {
public:
  Plane(int width, int height, int border)
      : border_(border),
        stride_(width + 2 * border),
        values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2 * border)) {}
  /// Floats y from its column 0 on; columns and rows reach `border` further.
  float* row(int y) { return values_.data() + static_cast<std::ptrdiff_t>(y + border_) * stride_ + border_; }
  const float* row(int y) const { return const_cast<Plane*>(this)->row(y); }

private:
  int border_;
  std::ptrdiff_t stride_;
  std::vector<float> values_;
};

template <class Value>
Plane plane_of(int width, int height, int border, const Value& value) {
  Plane plane(width, height, border);
  for (int y = -border; y < height + border; ++y) {
    float* const row = plane.row(y);
    const int from_y = std::clamp(y, 0, height - 1);
    for (int x = -border; x < width + border; ++x) row[x] = value(std::clamp(x, 0, width - 1), from_y);
  }
  return plane;
}

using Features = std::array<Plane, features>;

/// What is fitted: colours, and what they are linear in.
struct Fitted {
  std::array<Plane, 3> color;
  Features feature;
};

/// What squares of pixels are compared by.
struct Guide {
  std::array<Plane, 3> color;
  Plane variance;
  Plane tolerance;  // of squared differences without noise
};

void require(bool ok, const char* what) {
  if (!ok) throw SettingsError(std::string("denoising: ") + what);
}

void check(const NoisyPicture& p, const DenoiseSettings& s) {
  require(p.width > 0 && p.height > 0, "the picture is empty");
  const auto pixels = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
  require(p.color.size() == 3 * pixels && p.variance.size() == 3 * pixels && p.albedo.size() == 3 * pixels &&
              p.normal.size() == 3 * pixels && p.depth.size() == pixels,
          "colour, variance, albedo, normal and depth must be of one size");
  require(s.radius >= 1 && s.radius <= 32, "radius must be in 1 .. 32");
  require(s.patch_radius >= 0 && s.patch_radius <= 8, "patch_radius must be in 0 .. 8");
  require(s.strength > 0.0F && std::isfinite(s.strength), "strength must be > 0");
}

std::size_t pixel_of(const NoisyPicture& p, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(x);
}

std::array<Plane, 3> color_planes(const NoisyPicture& p, std::span<const float> color, int border) {
  const auto plane = [&](std::size_t c) {
    return plane_of(p.width, p.height, border,
                    [&](int x, int y) { return color[3 * pixel_of(p, x, y) + c]; });
  };
  return {plane(0), plane(1), plane(2)};
}

Features features_of(const NoisyPicture& p, int border) {
  const auto plane = [&](std::size_t k) {
    return plane_of(p.width, p.height, border, [&](int x, int y) {
      const std::size_t i = pixel_of(p, x, y);
      if (k < 3) return p.normal[3 * i + k] / normal_scale;
      if (k < 6) return p.albedo[3 * i + k - 3] / albedo_scale;
      const float z = std::isfinite(p.depth[i]) ? std::max(p.depth[i], 1e-6F) : nowhere;
      return std::log(z) / depth_scale;
    });
  };
  return {plane(0), plane(1), plane(2), plane(3), plane(4), plane(5), plane(6)};
}

Guide make_guide(const NoisyPicture& p, std::span<const float> color, float variance_share, int border) {
  // The variance is itself found from few samples: its mean over 3x3 pixels is steadier.
  const auto variance = [&](int x, int y) {
    float sum = 0.0F;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        for (std::size_t c = 0; c < 3; ++c)
          sum += p.variance[3 * pixel_of(p, std::clamp(x + i, 0, p.width - 1),
                                         std::clamp(y + j, 0, p.height - 1)) +
                            c];
    return variance_share * sum / 27.0F;
  };
  const auto tolerance = [&](int x, int y) {
    const float* c = &color[3 * pixel_of(p, x, y)];
    const float level = just_noticeable * (c[0] + c[1] + c[2]) / 3.0F;
    return level * level + 1e-12F;
  };
  return {color_planes(p, color, border), plane_of(p.width, p.height, border, variance),
          plane_of(p.width, p.height, border, tolerance)};
}

/// Falls from 1 to 0 at `end` much as exp(-d) does.
float falloff(float d, float end) {
  const float left = 1.0F - std::min(std::max(d, 0.0F), end) / end;
  return left * left * left * left;
}

/// Sums of the weighted least squares of the pixels of some rows.
class Fit {
public:
  explicit Fit(int width) : width_(width), sums_(static_cast<std::size_t>(terms * block_rows * width)) {}

  void clear() { std::fill(sums_.begin(), sums_.end(), 0.0F); }

  /// Takes in a pixel of the window of each pixel x in [begin, end) of row `row` (in the block): its weight,
  /// the features' differences to the middle, and its colour.
  void add(int row, int begin, int end, const float* weight, const std::array<Floats, features>& difference,
           const std::array<const float*, 3>& color) {
    int term = 0;
    accumulate(row, term++, begin, end, [&](int x) { return weight[x]; });
    for (int c = 0; c < 3; ++c) {
      const float* const value = color[static_cast<std::size_t>(c)];
      accumulate(row, term++, begin, end, [=](int x) { return weight[x] * value[x]; });
    }
    for (int k = 0; k < features; ++k) {
      const float* const a = difference[static_cast<std::size_t>(k)].data();
      accumulate(row, term++, begin, end, [=](int x) { return weight[x] * a[x]; });
      for (int c = 0; c < 3; ++c) {
        const float* const value = color[static_cast<std::size_t>(c)];
        accumulate(row, term++, begin, end, [=](int x) { return weight[x] * a[x] * value[x]; });
      }
      for (int l = 0; l <= k; ++l) {
        const float* const b = difference[static_cast<std::size_t>(l)].data();
        accumulate(row, term++, begin, end, [=](int x) { return weight[x] * a[x] * b[x]; });
      }
    }
  }

  /// The fitted colour in the middle of the window.
  Eigen::RowVector3f solve(int row, int x) const {
    int term = 0;
    const auto next = [&] { return sums_[place(row, term++) + static_cast<std::size_t>(x)]; };
    Eigen::Matrix<float, unknowns, unknowns> A;
    Eigen::Matrix<float, unknowns, 3> b;
    const float total = A(0, 0) = next();
    for (int c = 0; c < 3; ++c) b(0, c) = next();
    for (int k = 1; k < unknowns; ++k) {
      A(k, 0) = next();
      for (int c = 0; c < 3; ++c) b(k, c) = next();
      for (int l = 1; l <= k; ++l) A(k, l) = next();
      A(k, k) += ridge * total;
    }
    // Lower triangles are what the factorization reads.
    return A.llt().solve(b).row(0);
  }
  float total(int row, int x) const { return sums_[place(row, 0) + static_cast<std::size_t>(x)]; }

private:
  static constexpr int terms = 4 + features * 4 + features * (features + 1) / 2;

  std::size_t place(int row, int term) const {
    return static_cast<std::size_t>(term * block_rows + row) * static_cast<std::size_t>(width_);
  }
  template <class Value>
  void accumulate(int row, int term, int begin, int end, const Value& value) {
    float* const sum = sums_.data() + place(row, term);
    for (int x = begin; x < end; ++x) sum[x] += value(x);
  }

  int width_;
  std::vector<float> sums_;
};

/// What a thread works in.
struct Scratch {
  Scratch(int width, int patch_radius)
      : fit(width),
        difference(static_cast<std::size_t>(block_rows + 2 * patch_radius),
                   Floats(static_cast<std::size_t>(width + 2 * patch_radius))),
        columns(static_cast<std::size_t>(width + 2 * patch_radius)),
        weight(static_cast<std::size_t>(width)) {
    for (Floats& row : features_apart) row.resize(static_cast<std::size_t>(width));
  }
  Fit fit;
  std::vector<Floats> difference;  // of pixels, rows and columns from -patch_radius on
  Floats columns, weight;
  std::array<Floats, features> features_apart;
};

class Denoiser {
public:
  Denoiser(const Guide& guide, const Fitted& fitted, int width, int height, const DenoiseSettings& settings)
      : guide_(guide), fitted_(fitted), width_(width), height_(height), settings_(settings) {}

  void find_block(int first_row, Scratch& s, std::vector<float>& found) const {
    const int rows = std::min(block_rows, height_ - first_row);
    s.fit.clear();
    for (int dy = -settings_.radius; dy <= settings_.radius; ++dy)
      for (int dx = -settings_.radius; dx <= settings_.radius; ++dx) add_offset(first_row, rows, dx, dy, s);
    for (int row = 0; row < rows; ++row) {
      for (int x = 0; x < width_; ++x) {
        float* const out =
            &found[3 * (static_cast<std::size_t>(first_row + row) * static_cast<std::size_t>(width_) +
                        static_cast<std::size_t>(x))];
        const Eigen::RowVector3f color = s.fit.solve(row, x);
        for (int c = 0; c < 3; ++c) out[c] = std::max(color[c], 0.0F);
      }
    }
  }

private:
  void add_offset(int first_row, int rows, int dx, int dy, Scratch& s) const {
    const int f = settings_.patch_radius;
    int patch_row = first_row - f;
    for (Floats& apart : s.difference) {
      if (patch_row == first_row + rows + f) break;
      compare_row(patch_row++, dx, dy, apart.data() + f);
    }
    // Only pixels of the picture are taken in.
    const int begin = std::max(0, -dx), end = std::min(width_, width_ - dx);
    for (int row = 0; row < rows; ++row) {
      const int y = first_row + row;
      if (y + dy < 0 || y + dy >= height_ || begin >= end) continue;
      weigh_row(row, y, begin, end, dx, dy, s);
      std::array<const float*, 3> color;
      for (std::size_t c = 0; c < 3; ++c) color[c] = fitted_.color[c].row(y + dy) + dx;
      s.fit.add(row, begin, end, s.weight.data(), s.features_apart, color);
    }
  }

  /// How far the pixels of a row and those dx, dy from them are apart, in noise: about 0 where it is only
  /// noise.
  void compare_row(int y, int dx, int dy, float* apart) const {
    const int f = settings_.patch_radius;
    const float k2 = settings_.strength * settings_.strength;
    const float *v = guide_.variance.row(y), *v2 = guide_.variance.row(y + dy) + dx,
                *tolerance = guide_.tolerance.row(y);
    const float *r = guide_.color[0].row(y), *r2 = guide_.color[0].row(y + dy) + dx;
    const float *g = guide_.color[1].row(y), *g2 = guide_.color[1].row(y + dy) + dx;
    const float *b = guide_.color[2].row(y), *b2 = guide_.color[2].row(y + dy) + dx;
    for (int x = -f; x < width_ + f; ++x) {
      const float dr = r[x] - r2[x], dg = g[x] - g2[x], db = b[x] - b2[x];
      const float squared = (dr * dr + dg * dg + db * db) * (1.0F / 3.0F);
      apart[x] = (squared - v[x] - std::min(v[x], v2[x])) / (tolerance[x] + k2 * (v[x] + v2[x]));
    }
  }

  void weigh_row(int row, int y, int begin, int end, int dx, int dy, Scratch& s) const {
    const int f = settings_.patch_radius;
    float* const columns = s.columns.data() + f;
    std::fill(s.columns.begin(), s.columns.end(), 0.0F);
    const auto first = s.difference.begin() + row;
    for (auto patch_row = first; patch_row != first + 2 * f + 1; ++patch_row) {
      const float* const apart = patch_row->data() + f;
      for (int x = begin - f; x < end + f; ++x) columns[x] += apart[x];
    }
    for (std::size_t k = 0; k < features; ++k) {
      const float *here = fitted_.feature[k].row(y), *there = fitted_.feature[k].row(y + dy) + dx;
      float* const apart = s.features_apart[k].data();
      for (int x = begin; x < end; ++x) apart[x] = there[x] - here[x];
    }
    const float mean = 1.0F / static_cast<float>((2 * f + 1) * (2 * f + 1));
    float* const weight = s.weight.data();
    for (int x = begin; x < end; ++x) weight[x] = 0.0F;
    for (int i = -f; i <= f; ++i)
      for (int x = begin; x < end; ++x) weight[x] += columns[x + i];
    const auto square = [&](std::size_t k, int x) {
      return s.features_apart[k][static_cast<std::size_t>(x)] *
             s.features_apart[k][static_cast<std::size_t>(x)];
    };
    for (int x = begin; x < end; ++x) {
      const float normal = square(0, x) + square(1, x) + square(2, x);
      const float albedo = square(3, x) + square(4, x) + square(5, x);
      weight[x] =
          falloff(mean * weight[x], 4.0F) * falloff(std::max(std::max(normal, albedo), square(6, x)), 1.0F);
    }
    if (dx == 0 && dy == 0)
      for (int x = begin; x < end; ++x) weight[x] = 1.0F;
  }

  const Guide& guide_;
  const Fitted& fitted_;
  int width_, height_;
  DenoiseSettings settings_;
};

std::vector<float> run(const Guide& guide, const Fitted& fitted, const NoisyPicture& p,
                       const DenoiseSettings& settings) {
  std::vector<float> found(p.color.size());
  const Denoiser denoiser(guide, fitted, p.width, p.height, settings);
  const int blocks = (p.height + block_rows - 1) / block_rows;
  tbb::enumerable_thread_specific<Scratch> scratch([&] { return Scratch(p.width, settings.patch_radius); });
  tbb::parallel_for(0, blocks, [&](int k) { denoiser.find_block(k * block_rows, scratch.local(), found); });
  return found;
}

}  // namespace

int denoising_reach(const DenoiseSettings& settings) {
  return 2 * (settings.radius + settings.patch_radius) + 2;  // of both passes, and their variances
}

std::vector<float> denoise(const NoisyPicture& p, const DenoiseSettings& settings) {
  check(p, settings);
  const int border = settings.radius + settings.patch_radius;
  const Fitted fitted{color_planes(p, p.color, border), features_of(p, border)};
  const std::vector<float> once = run(make_guide(p, p.color, 1.0F, border), fitted, p, settings);
  // Once more, the squares compared in what was found: weights that the noise has no say in.
  return run(make_guide(p, once, residual_share, border), fitted, p, settings);
}

}  // namespace lagomorph::render
