#include "apps/preview/small_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lagomorph::apps {
namespace {

using render::Picture;

/// What of a line's samples becomes one sample of a shorter line: from `first` on, by weights that sum to 1.
struct Share {
  int first = 0;
  std::vector<float> weights;
};

std::vector<Share> shares(int from, int to) {
  std::vector<Share> all(static_cast<std::size_t>(to));
  const double step = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Share& share = all[static_cast<std::size_t>(i)];
    const double begin = i * step, end = std::min((i + 1) * step, static_cast<double>(from));
    share.first = static_cast<int>(begin);
    for (int j = share.first; j < end; ++j) {
      const double covered = std::min<double>(end, j + 1) - std::max<double>(begin, j);
      if (covered > 1e-9 || share.weights.empty())
        share.weights.push_back(static_cast<float>(covered / step));
    }
  }
  return all;
}

std::array<float, 256> linear_table() {
  std::array<float, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = render::linear_from_srgb(static_cast<float>(i) / 255.0F);
  return table;
}

std::size_t offset(int width, int x, int y) {
  return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
}

}  // namespace

Picture opaque_picture(const render::Pixels& pixels) {
  Picture picture{pixels.width, pixels.height, {}};
  picture.rgb.reserve(3 * pixels.pixel_count());
  const auto step = static_cast<std::size_t>(pixels.samples_per_pixel());
  std::visit(
      [&](const auto& samples) {
        const std::uint64_t most = pixels.bit_depth() == 16 ? 65535 : 255;
        for (std::size_t i = 0; i < samples.size(); i += step) {
          const std::uint64_t alpha = pixels.alpha ? samples[i + 3] : most;
          for (std::size_t c = 0; c < 3; ++c) {
            const std::uint64_t over_white = samples[i + c] * alpha + most * (most - alpha);
            picture.rgb.push_back(
                static_cast<std::uint8_t>((over_white * 255 + most * most / 2) / (most * most)));
          }
        }
      },
      pixels.samples);
  return picture;
}

Size size_within(Size of, Size box) {
  const double scale =
      std::min({1.0, static_cast<double>(box.width) / of.width, static_cast<double>(box.height) / of.height});
  return {std::max(1, static_cast<int>(std::lround(of.width * scale))),
          std::max(1, static_cast<int>(std::lround(of.height * scale)))};
}

Picture resized(const Picture& picture, Size to) {
  if (to == Size{picture.width, picture.height}) return picture;
  static const std::array<float, 256> linear = linear_table();
  const std::vector<Share> columns = shares(picture.width, to.width),
                           rows = shares(picture.height, to.height);
  // Rows first get shorter, then fewer.
  std::vector<float> narrow(offset(to.width, 0, picture.height));
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      const Share& share = columns[static_cast<std::size_t>(x)];
      for (std::size_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (std::size_t i = 0; i < share.weights.size(); ++i)
          sum += share.weights[i] * linear[picture.rgb[offset(picture.width, share.first, y) + 3 * i + c]];
        narrow[offset(to.width, x, y) + c] = sum;
      }
    }
  }
  Picture small{to.width, to.height, std::vector<std::uint8_t>(offset(to.width, 0, to.height))};
  const std::size_t line = offset(to.width, 0, 1);
  for (int y = 0; y < to.height; ++y) {
    const Share& share = rows[static_cast<std::size_t>(y)];
    for (std::size_t i = 0; i < line; ++i) {
      float sum = 0;
      for (std::size_t j = 0; j < share.weights.size(); ++j)
        sum += share.weights[j] * narrow[offset(to.width, 0, share.first) + line * j + i];
      small.rgb[offset(to.width, 0, y) + i] =
          static_cast<std::uint8_t>(std::lround(255.0F * render::srgb_from_linear(sum)));
    }
  }
  return small;
}

void put_picture(Picture& canvas, int x, int y, const Picture& picture) {
  const int left = std::max(0, -x), right = std::min(picture.width, canvas.width - x);
  if (left >= right) return;
  for (int row = std::max(0, -y); row < std::min(picture.height, canvas.height - y); ++row) {
    std::copy_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(offset(picture.width, left, row)),
                3 * (right - left),
                canvas.rgb.begin() + static_cast<std::ptrdiff_t>(offset(canvas.width, x + left, y + row)));
  }
}

Picture filled(Size size, const std::array<std::uint8_t, 3>& color) {
  Picture canvas{size.width, size.height, std::vector<std::uint8_t>(offset(size.width, 0, size.height))};
  for (std::size_t i = 0; i < canvas.rgb.size(); ++i) canvas.rgb[i] = color[i % 3];
  return canvas;
}

}  // namespace lagomorph::apps
