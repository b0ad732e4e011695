#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/preview/material.h"
#include "apps/preview/small_picture.h"
#include "apps/progress/progress.h"

namespace lagomorph::apps {

/// A frame that is shown: its picture made small, or why there is none.
struct ShownFrame {
  int frame = 0;
  std::filesystem::path small;  // a PNG of Shown::size; empty: it cannot be read
  Size size;                    // of the picture itself
  std::string problem;          // one line, when it cannot be read
};

/// The pictures of a preview, evenly chosen, all made small to one size.
struct Shown {
  std::vector<ShownFrame> frames;  // ascending
  int every = 1;                   // of how many pictures one is shown
  Size picture;                    // the pictures' size; of the first one that can be read
  Size size;                       // of the small ones
  std::vector<const ShownFrame*> readable() const;
};

/// A folder beside what is made, gone with this object.
class WorkFolder {
public:
  explicit WorkFolder(const std::filesystem::path& out);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// `most` of n, evenly, the first and the last among them: indices, ascending.
std::vector<std::size_t> evenly(std::size_t n, std::size_t most);

/// What is to be shown of the material; the first picture that can be read gives its size to all. Writes
/// nothing. Throws Error(wrong_input) when none can be read; empty without pictures.
Shown choose_shown(const PreviewMaterial&);

/// Reads the pictures and writes small ones into the folder, in parallel; what is of another size is fitted
/// in. Tells the material of pictures that cannot be read or are of other sizes. Throws Error(machine) when
/// one cannot be written.
void make_small(Shown&, PreviewMaterial&, const std::filesystem::path& folder, Progress&);

}  // namespace lagomorph::apps
