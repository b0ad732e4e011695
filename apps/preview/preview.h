#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/preview/animation.h"
#include "apps/preview/material.h"
#include "apps/preview/shown.h"

namespace lagomorph::apps {

/// A preview that was made: what it shows, and its files' names in `out`.
struct Preview {
  PreviewMaterial material;
  Shown shown;  // the small pictures are gone when the command ends
  std::filesystem::path out;
  std::string contact_sheet;  // empty: there are no pictures
  std::vector<Animation> animations;
  std::string page;
};

/// summary.md: for a job summary or a merge request, under 64 KiB. The picture stands alone on its line.
std::string summary_markdown(const Preview&);
/// One JSON object on one line.
std::string preview_json(const Preview&);
/// What a person at a terminal reads.
std::string preview_text(const Preview&);

}  // namespace lagomorph::apps
