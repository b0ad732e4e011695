#include "apps/nearest.h"

#include <algorithm>
#include <vector>

namespace lagomorph::apps {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table of distances between prefixes: the last but one, the last, the current.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest(std::string_view written, std::span<const std::string> known) {
  constexpr std::size_t longest = 64;  // no name is; the table of distances stays small
  if (written.size() > longest) return {};
  std::string best;
  int best_distance = std::max(1, static_cast<int>(written.size()) / 3) + 1;
  for (const std::string& name : known) {
    const int distance = edit_distance(written, name);
    if (distance < best_distance && distance < static_cast<int>(name.size())) {
      best = name;
      best_distance = distance;
    }
  }
  if (!best.empty()) return best;
  constexpr std::size_t telling = 3;  // letters; fewer are a part of anything
  for (const std::string& name : known) {
    const std::string_view shorter = written.size() < name.size() ? written : name;
    const std::string_view longer = written.size() < name.size() ? std::string_view(name) : written;
    if (shorter.size() >= telling && longer.find(shorter) != std::string_view::npos) return name;
  }
  return {};
}

std::string joined(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace lagomorph::apps
