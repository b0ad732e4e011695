#include "apps/check/picture_folder.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/run/run_json.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

bool is_png(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".png" && !file.filename().string().starts_with(".");
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Those of a run's pictures. A run.json that another program wrote tells nothing.
FrameNames names_told(const fs::path& root) {
  try {
    return paths_of_run(root).names();
  } catch (const Error& error) {
    if (error.status != ExitStatus::wrong_input) throw;
    return {};
  }
}

}  // namespace

fs::path PictureFolder::of(int frame) const {
  const auto found = pictures.find(frame);
  return found == pictures.end() ? fs::path() : found->second;
}

std::optional<int> picture_number(const fs::path& file) {
  const std::string stem = file.stem().string();
  const auto last = std::find_if(stem.rbegin(), stem.rend(), is_digit);
  const auto before = std::find_if_not(last, stem.rend(), is_digit);
  const std::string digits(before.base(), last.base());
  int number = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || error != std::errc()) return std::nullopt;
  return number;
}

PictureFolder list_pictures_in(const fs::path& folder, const FrameNames& names) {
  PictureFolder result{folder, {}, {}};
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!is_png(entry.path()) || entry.is_directory(error)) continue;
    std::optional<int> number = names.frame_of(entry.path(), entry.path().extension().string());
    if (!number) number = picture_number(entry.path());
    if (!number) {
      result.unnumbered.push_back(entry.path().filename().string());
      continue;
    }
    const auto [there, is_new] = result.pictures.emplace(*number, entry.path());
    if (is_new) continue;
    std::string names[] = {there->second.filename().string(), entry.path().filename().string()};
    std::sort(std::begin(names), std::end(names));  // a folder has no order
    wrong_input(fmt::format("{}: {} and {} are both frame {}", folder.string(), names[0], names[1], *number));
  }
  std::sort(result.unnumbered.begin(), result.unnumbered.end());
  return result;
}

PictureFolder list_pictures(const fs::path& root, const std::string& what) {
  std::error_code error;
  if (!fs::exists(root, error)) wrong_input(fmt::format("{}: there is no such {}", root.string(), what));
  if (!fs::is_directory(root, error))
    wrong_input(fmt::format("{}: is no folder, so no {}", root.string(), what));
  return list_pictures_in(fs::is_directory(root / "frames", error) ? root / "frames" : root,
                          names_told(root));
}

}  // namespace lagomorph::apps
