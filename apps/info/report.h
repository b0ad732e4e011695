#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "sim/types.h"

namespace lagomorph::apps {

/// What `info` tells: the same facts as lines for people and as JSON.
class Report {
public:
  /// "bunny.msh: tetrahedral mesh"; `kind` is what programs ask for.
  Report(const std::string& title, const std::string& kind, const std::string& file);

  /// A fact: `text` after its label for people, `value` under `key` in JSON.
  void add(const std::string& label, const std::string& text, const std::string& key,
           nlohmann::ordered_json value);
  /// A fact for JSON alone, and a line for people alone: what the other has elsewhere.
  void add_json(const std::string& key, nlohmann::ordered_json value) { json_[key] = std::move(value); }
  void add_text(const std::string& label, const std::string& text) { rows_.emplace_back(label, text); }

  std::string text() const;
  std::string json() const;

private:
  std::string title_;
  std::vector<std::pair<std::string, std::string>> rows_;
  nlohmann::ordered_json json_;
};

/// "12,345" of a count >= 0.
std::string count_text(long long count);
/// Four significant digits.
std::string number_text(double value);
/// "[0, 1, 2]" by four significant digits.
std::string point_text(const sim::Vec3& point);
/// The box's corners and extents as facts [m].
void add_box(Report&, const sim::Vec3& min, const sim::Vec3& max);
/// One fact for all that a reader or check remarked.
void add_remarks(Report&, const std::vector<std::string>& remarks);

}  // namespace lagomorph::apps
