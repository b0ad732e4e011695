#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/frame_names.h"

namespace lagomorph::apps {

/// The numbered PNG files of a folder.
struct PictureFolder {
  std::filesystem::path folder;
  std::map<int, std::filesystem::path> pictures;  // by frame
  std::vector<std::string> unnumbered;            // names without a number, sorted

  /// Empty when there is none.
  std::filesystem::path of(int frame) const;
};

/// The frame of a picture's name: the last number in it, as in frame_0012.png, img12.png, 0012.png.
std::optional<int> picture_number(const std::filesystem::path& file);

/// ROOT/frames where that is a folder, otherwise ROOT itself; a run's pictures by the pattern that its
/// run.json tells. `what` names it in messages. Throws Error(wrong_input) when there is no such folder or two
/// of its pictures have the same number.
PictureFolder list_pictures(const std::filesystem::path& root, const std::string& what);
/// This folder itself, whose pictures may have names of that form; none of it is there when it is not.
PictureFolder list_pictures_in(const std::filesystem::path& folder, const FrameNames& names = {});

}  // namespace lagomorph::apps
