#include "apps/frame_names.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace {

constexpr std::string_view png = ".png";
constexpr std::size_t most_digits = 16;

/// Whether it can be a name in a folder, and in ffmpeg's lists of files.
bool is_plain(const std::string& name) {
  return name.front() != '.' && std::none_of(name.begin(), name.end(), [](char c) {
           return c == '/' || c == '|' || static_cast<unsigned char>(c) < 0x20;
         });
}

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) all += c == '%' ? std::string("%%") : std::string(1, c);
  return all;
}

}  // namespace

FrameNames::FrameNames(const std::string& pattern) {
  const std::size_t last = pattern.find_last_of('#');
  const std::size_t other = last == std::string::npos ? last : pattern.find_last_not_of('#', last);
  const std::size_t first = other == std::string::npos ? 0 : other + 1;
  if (last == std::string::npos || !pattern.ends_with(png) || !is_plain(pattern) ||
      last - first >= most_digits) {
    wrong_input(
        fmt::format("--pattern {}: must be a plain name that ends in .png, with # for the digits of the "
                    "frame, as shot.####.png",
                    pattern));
  }
  before_ = pattern.substr(0, first);
  digits_ = last - first + 1;
  after_ = pattern.substr(last + 1, pattern.size() - png.size() - last - 1);
}

std::string FrameNames::pattern() const {
  return before_ + std::string(digits_, '#') + after_ + std::string(png);
}

std::string FrameNames::file(int frame, std::string_view extension) const {
  return fmt::format("{}{:0{}}{}{}", before_, frame, digits_, after_, extension);
}

std::optional<int> FrameNames::frame_of(const std::filesystem::path& file, std::string_view extension) const {
  const std::string name = file.filename().string();
  if (name.size() <= before_.size() + after_.size() + extension.size()) return std::nullopt;
  int frame = -1;
  std::from_chars(name.data() + before_.size(), name.data() + name.size(), frame);
  if (frame < 0 || name != this->file(frame, extension)) return std::nullopt;
  return frame;
}

std::string FrameNames::printf_format() const {
  return fmt::format("{}%0{}d{}", escaped(before_), digits_, escaped(after_));
}

}  // namespace lagomorph::apps
