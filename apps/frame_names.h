#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace lagomorph::apps {

/// Names of the files of a sequence, in which a number of so many digits at least stands for the frame.
class FrameNames {
public:
  /// frame_0000; numbers grow past 9999.
  FrameNames() = default;
  /// Those of shot.####.png, in which the last run of # stands for the frame's number. Throws
  /// Error(wrong_input) for a pattern without one, or that is no plain name of a .png.
  explicit FrameNames(const std::string& pattern);

  /// "shot.####.png".
  std::string pattern() const;
  /// The name of a frame's file.
  std::string file(int frame, std::string_view extension) const;
  /// The frame of a file's name of that form; nullopt for any other name.
  std::optional<int> frame_of(const std::filesystem::path& file, std::string_view extension) const;
  /// "shot.%04d", as ffmpeg takes it.
  std::string printf_format() const;

  bool operator==(const FrameNames&) const = default;

private:
  std::string before_ = "frame_", after_;
  std::size_t digits_ = 4;
};

}  // namespace lagomorph::apps
