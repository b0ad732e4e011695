#include "apps/check/golden_folder.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

fs::path variant_pictures(const fs::path& golden, const std::string& name) {
  return golden / "variants" / name / "frames";
}

std::set<int> GoldenFolder::frames() const {
  std::set<int> all;
  for (const auto& [frame, file] : own.pictures) all.insert(frame);
  for (const auto& [frame, hash] : hashes) all.insert(frame);
  for (const auto& [name, folder] : variants) {
    for (const auto& [frame, file] : folder.pictures) all.insert(frame);
  }
  return all;
}

std::vector<GoldenFolder::Candidate> GoldenFolder::candidates(
    int frame, const std::optional<std::string>& variant) const {
  std::vector<Candidate> all;
  if (variant) {
    const auto found = variants.find(*variant);
    if (found != variants.end() && !found->second.of(frame).empty())
      return {{found->second.of(frame), *variant}};
  }
  if (const fs::path picture = own.of(frame); !picture.empty()) all.push_back({picture, ""});
  if (variant) return all;
  for (const auto& [name, folder] : variants) {
    if (const fs::path picture = folder.of(frame); !picture.empty()) all.push_back({picture, name});
  }
  return all;
}

GoldenFolder read_golden_folder(const fs::path& root) {
  GoldenFolder golden{
      root, list_pictures(root, "golden (lagomorph approve makes one)"), {}, read_hashes(root)};
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(root / "variants", error)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory(error)) golden.variants[name] = list_pictures_in(variant_pictures(root, name));
  }
  return golden;
}

}  // namespace lagomorph::apps
