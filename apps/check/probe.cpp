#include "apps/check/probe.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "render/image_compare/differences.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

constexpr int farthest = 3;           // pixels of a shift
constexpr int frames_away = 2;        // of a neighbour
constexpr double much_nearer = 0.25;  // of the difference that is left
constexpr int rows_probed = 256;      // at most, of a shift

/// R + G + B a pixel.
std::vector<int> grey(const render::Pixels& pixels) {
  std::vector<int> values(pixels.pixel_count());
  const auto step = static_cast<std::size_t>(pixels.samples_per_pixel());
  std::visit(
      [&](const auto& samples) {
        for (std::size_t i = 0; i < values.size(); ++i)
          values[i] = samples[i * step] + samples[i * step + 1] + samples[i * step + 2];
      },
      pixels.samples);
  return values;
}

std::string pixels_text(int n, const char* where) {
  return fmt::format("{} pixel{} {}", n, n == 1 ? "" : "s", where);
}

}  // namespace

std::string shift_text(const PixelShift& s) {
  std::string text;
  if (s.x != 0) text = pixels_text(std::abs(s.x), s.x > 0 ? "to the right" : "to the left");
  if (s.y != 0) text += (text.empty() ? "" : " and ") + pixels_text(std::abs(s.y), s.y > 0 ? "down" : "up");
  return text;
}

std::optional<PixelShift> find_shift(const render::Pixels& golden, const render::Pixels& fresh) {
  const int width = golden.width, height = golden.height;
  if (std::min(width, height) < 8 * farthest) return std::nullopt;
  const std::vector<int> a = grey(golden), b = grey(fresh);
  const int stride = std::max(1, height / rows_probed);
  const auto squares = [&](const PixelShift& s) {
    double sum = 0;
    for (int y = farthest; y < height - farthest; y += stride) {
      const int* p = a.data() + static_cast<std::ptrdiff_t>(y - s.y) * width - s.x;
      const int* q = b.data() + static_cast<std::ptrdiff_t>(y) * width;
      std::int64_t row = 0;
      for (int x = farthest; x < width - farthest; ++x) row += std::int64_t{q[x] - p[x]} * (q[x] - p[x]);
      sum += static_cast<double>(row);
    }
    return sum;
  };
  const double now = squares({});
  double least = much_nearer * now;
  std::optional<PixelShift> found;
  for (int away = 1; away <= 2 * farthest; ++away) {  // of equals the nearest
    for (int y = -farthest; y <= farthest; ++y) {
      for (int x = -farthest; x <= farthest; ++x) {
        if (std::abs(x) + std::abs(y) != away) continue;
        const double sum = squares({x, y});
        if (sum >= least) continue;
        least = sum;
        found = PixelShift{x, y};
      }
    }
  }
  return found;
}

std::optional<int> find_frame(const PictureFolder& goldens, int frame, const render::Pixels& golden,
                              const render::Pixels& fresh) {
  double least = much_nearer * render::color_differences(golden, fresh).mean_absolute();
  std::optional<int> found;
  for (int away = 1; away <= frames_away; ++away) {
    for (const int other : {frame + away, frame - away}) {
      const auto file = goldens.pictures.find(other);
      if (file == goldens.pictures.end()) continue;
      try {
        const render::Pixels picture = render::read_png(read_file(file->second), file->second.string());
        if (picture.width != fresh.width || picture.height != fresh.height ||
            picture.bit_depth() != fresh.bit_depth())
          continue;
        const double difference = render::color_differences(picture, fresh).mean_absolute();
        if (difference > least || (found && difference == least)) continue;
        least = difference;
        found = other;
      } catch (const std::runtime_error&) {
        // An unreadable neighbour is told as a failure of its own frame.
      }
    }
  }
  return found;
}

Probe probe_frame(const PictureFolder& goldens, int frame, const render::Pixels& golden,
                  const render::Pixels& fresh) {
  Probe probe;
  probe.matches = find_frame(goldens, frame, golden, fresh);
  if (probe.matches) return probe;
  probe.tone = find_tone(golden, fresh);
  if (probe.tone.empty()) probe.shift = find_shift(golden, fresh);
  return probe;
}

std::vector<std::string> Probe::hints() const {
  std::vector<std::string> all;
  if (matches) all.push_back(fmt::format("matches the golden's frame {}", *matches));
  if (shift) all.push_back("shifted by " + shift_text(*shift));
  if (!tone.empty()) all.push_back("only the tones differ: " + tone);
  return all;
}

}  // namespace lagomorph::apps
