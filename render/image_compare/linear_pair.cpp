#include "render/image_compare/linear_pair.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace lagomorph::render {
namespace {

/// Linear light of every sample by the exact curve of IEC 61966-2-1.
template <class Sample>
const std::vector<float>& linear_table() {
  static const std::vector<float> table = [] {
    constexpr int most = std::numeric_limits<Sample>::max();
    std::vector<float> values;
    for (int i = 0; i <= most; ++i) {
      const double s = static_cast<double>(i) / most;
      values.push_back(static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4)));
    }
    return values;
  }();
  return table;
}

template <class Sample>
class PixelPair : public LinearPair {
public:
  PixelPair(const Pixels& first, const Pixels& second)
      : LinearPair(first.width, first.height), views_{View(first), View(second)} {}

  void read(int which, int y, int x, int count, float* red, float* green, float* blue) const override {
    const View& view = views_[static_cast<std::size_t>(which)];
    const Sample* p = at(view, y, x);
    const float* table = table_.data();
    for (int i = 0; i < count; ++i, p += view.step) {
      red[i] = table[p[0]];
      green[i] = table[p[1]];
      blue[i] = table[p[2]];
    }
  }

  bool same(int y, int x, int count) const override {
    const Sample* p = at(views_[0], y, x);
    const Sample* q = at(views_[1], y, x);
    const bool dense = views_[0].step == 3 && views_[1].step == 3;
    if (dense) return std::equal(p, p + std::ptrdiff_t{3} * count, q);
    for (int i = 0; i < count; ++i, p += views_[0].step, q += views_[1].step) {
      if (p[0] != q[0] || p[1] != q[1] || p[2] != q[2]) return false;
    }
    return true;
  }

private:
  struct View {
    explicit View(const Pixels& pixels)
        : samples(std::get<std::vector<Sample>>(pixels.samples).data()), step(pixels.samples_per_pixel()) {}
    const Sample* samples;
    int step;
  };

  const Sample* at(const View& view, int y, int x) const {
    return view.samples + (static_cast<std::ptrdiff_t>(y) * width() + x) * view.step;
  }

  std::array<View, 2> views_;
  const std::vector<float>& table_ = linear_table<Sample>();
};

}  // namespace

std::unique_ptr<LinearPair> linear_pair(const Pixels& first, const Pixels& second) {
  if (first.bit_depth() == 8) return std::make_unique<PixelPair<std::uint8_t>>(first, second);
  return std::make_unique<PixelPair<std::uint16_t>>(first, second);
}

}  // namespace lagomorph::render
