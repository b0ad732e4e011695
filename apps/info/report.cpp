#include "apps/info/report.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "apps/one_line.h"

namespace lagomorph::apps {

Report::Report(const std::string& title, const std::string& kind, const std::string& file)
    : title_(title), json_({{"kind", kind}, {"file", file}}) {}

void Report::add(const std::string& label, const std::string& text, const std::string& key,
                 nlohmann::ordered_json value) {
  rows_.emplace_back(label, text);
  json_[key] = std::move(value);
}

std::string Report::text() const {
  std::size_t width = 0;
  for (const auto& [label, text] : rows_) width = std::max(width, label.size());
  std::string all = one_line(title_) + "\n";
  for (const auto& [label, text] : rows_) all += fmt::format("  {:<{}}  {}\n", label, width, one_line(text));
  return all;
}

std::string Report::json() const {
  // A file's name may be any bytes.
  return json_.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string count_text(long long count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string number_text(double value) { return fmt::format("{:.4g}", value); }

std::string point_text(const sim::Vec3& point) {
  return fmt::format("[{}, {}, {}]", number_text(point.x()), number_text(point.y()), number_text(point.z()));
}

void add_box(Report& report, const sim::Vec3& min, const sim::Vec3& max) {
  const auto json = [](const sim::Vec3& v) { return std::array{v.x(), v.y(), v.z()}; };
  const sim::Vec3 size = max - min;
  report.add("bounding box", fmt::format("{} to {} m", point_text(min), point_text(max)), "bounding_box",
             {{"min", json(min)}, {"max", json(max)}});
  report.add(
      "size",
      fmt::format("{} x {} x {} m", number_text(size.x()), number_text(size.y()), number_text(size.z())),
      "size", json(size));
}

void add_remarks(Report& report, const std::vector<std::string>& remarks) {
  if (remarks.empty()) return;
  report.add("remark", remarks[0], "remarks", remarks);
  for (std::size_t i = 1; i < remarks.size(); ++i) report.add_text("remark", remarks[i]);
}

}  // namespace lagomorph::apps
