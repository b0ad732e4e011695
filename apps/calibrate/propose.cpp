#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "apps/calibrate/calibration.h"
#include "apps/frame_ranges.h"

namespace lagomorph::apps {
namespace {

constexpr double room = 1.5;  // between what is harmless and what is not, at least

struct Told {
  double value = 0;
  const CalibrationCase* of = nullptr;
  std::string text() const {
    return of == nullptr ? "0" : fmt::format("{:.3g} ({}, frame {})", value, of->name, of->result.frame);
  }
};

/// Of one figure: the largest of what is harmless, the least of each fault.
struct Spread {
  Told harmless;
  std::map<std::string, Told> faults;
};

Spread spread(const std::vector<CalibrationCase>& cases, const CalibratedFigure& figure) {
  Spread s;
  for (const CalibrationCase& c : cases) {
    const double value = figure.value(c.result);
    if (c.harmless) {
      if (s.harmless.of == nullptr || value > s.harmless.value) s.harmless = {value, &c};
    } else {
      const auto [told, is_new] = s.faults.try_emplace(c.name, Told{value, &c});
      if (!is_new && value < told->second.value) told->second = {value, &c};
    }
  }
  return s;
}

bool tells(const Spread& s, const std::string& fault) {
  const double value = s.faults.at(fault).value;
  return value > 0 && value >= room * s.harmless.value;
}

/// Three digits are enough: neighbours are 1 % apart, the two sides 22 % or more away.
double three_digits(double value) { return std::stod(fmt::format("{:.3g}", value)); }

/// What a limit tells of the faults that nothing else has told yet.
struct Choice {
  std::set<std::string> faults;
  double ratio = 0;  // of the least of them to what is harmless
  bool operator<(const Choice& other) const {
    return std::pair(faults.size(), ratio) < std::pair(other.faults.size(), other.ratio);
  }
};

Choice choice_of(const Spread& s, const std::set<std::string>& left) {
  Choice choice;
  double least = std::numeric_limits<double>::infinity();
  for (const std::string& fault : left) {
    if (!tells(s, fault)) continue;
    choice.faults.insert(fault);
    least = std::min(least, s.faults.at(fault).value);
  }
  if (!choice.faults.empty()) choice.ratio = least / std::max(s.harmless.value, 1e-6);
  return choice;
}

ProposedLimit between(const CalibratedFigure& figure, const Spread& s, const std::set<std::string>& faults) {
  Told least{std::numeric_limits<double>::infinity(), nullptr};
  for (const std::string& fault : faults) {
    if (s.faults.at(fault).value < least.value) least = s.faults.at(fault);
  }
  const double limit = s.harmless.value > 0 ? std::sqrt(s.harmless.value * least.value) : least.value / 2;
  return {figure.name, three_digits(limit),
          fmt::format("harmless up to {}, faults from {}", s.harmless.text(), least.text())};
}

/// The figure that is preferred is limited by whatever it tells, though another tells more.
void add_first(const std::vector<Spread>& spreads, Proposal& proposal) {
  const CalibratedFigure& figure = calibrated_figures().front();
  const Spread& s = spreads.front();
  std::set<std::string> faults;
  for (const auto& [fault, told] : s.faults) {
    if (tells(s, fault)) faults.insert(fault);
  }
  const bool has = std::any_of(proposal.limits.begin(), proposal.limits.end(),
                               [&](const ProposedLimit& l) { return l.name == figure.name; });
  if (!has && !faults.empty()) proposal.limits.insert(proposal.limits.begin(), between(figure, s, faults));
}

/// Limits of the preset that harmless pictures would break, or nearly, are made to pass them.
void loosen_others(const std::vector<Spread>& spreads, Proposal& proposal) {
  const Limits preset = preset_limits("render", "");
  const auto has = [&](LimitName name) {
    return std::any_of(proposal.limits.begin(), proposal.limits.end(),
                       [&](const ProposedLimit& l) { return l.name == name; });
  };
  const auto& figures = calibrated_figures();
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const LimitValue& limit = preset[figures[i].name];
    const double most = spreads[i].harmless.value;
    if (limit.value && !has(figures[i].name) && room * most > *limit.value) {
      proposal.limits.push_back(
          {figures[i].name, std::nullopt, fmt::format("harmless up to {}", spreads[i].harmless.text())});
    }
    // Of two frames with independent noise the bias changes by the sum of both at most.
    const bool tile = figures[i].name == LimitName::bias_tile_max;
    if (!tile && figures[i].name != LimitName::bias_mean) continue;
    const LimitName flicker = tile ? LimitName::flicker_tile_max : LimitName::flicker_mean;
    if (2 * room * most > preset[flicker].value.value_or(2)) {
      proposal.limits.push_back({flicker, three_digits(2 * room * most),
                                 fmt::format("three times the harmless {}", spreads[i].harmless.text())});
    }
  }
}

}  // namespace

const std::vector<CalibratedFigure>& calibrated_figures() {
  using enum LimitName;
  static const std::vector<CalibratedFigure> all = {
      {flip_tile_max, [](const FrameResult& f) { return f.figures->flip_tile.mean; }},
      {flip_mean, [](const FrameResult& f) { return f.figures->flip_mean; }},
      {bias_tile_max, [](const FrameResult& f) { return f.bias->tile.mean; }},
      {bias_mean, [](const FrameResult& f) { return f.bias->mean; }},
      {mean_abs, [](const FrameResult& f) { return f.figures->differences.mean_absolute(); }},
      {rmse, [](const FrameResult& f) { return f.figures->differences.root_mean_square(); }},
  };
  return all;
}

Proposal propose_limits(const std::vector<CalibrationCase>& cases) {
  Proposal proposal;
  std::vector<Spread> spreads;
  for (const CalibratedFigure& figure : calibrated_figures()) spreads.push_back(spread(cases, figure));
  std::set<std::string> left;
  for (const auto& [fault, told] : spreads.front().faults) left.insert(fault);
  while (!left.empty()) {
    std::size_t best = 0;
    Choice chosen;
    for (std::size_t i = 0; i < spreads.size(); ++i) {
      if (const Choice choice = choice_of(spreads[i], left); chosen < choice) {
        chosen = choice;
        best = i;
      }
    }
    if (chosen.faults.empty()) break;
    proposal.limits.push_back(between(calibrated_figures()[best], spreads[best], chosen.faults));
    for (const std::string& fault : chosen.faults) left.erase(fault);
  }
  add_first(spreads, proposal);
  for (const std::string& fault : left) {
    const Spread& s = spreads.front();
    proposal.no_room.push_back(fmt::format("{}: {} {}, while harmless are up to {}", fault,
                                           limit_row(calibrated_figures().front().name).name,
                                           s.faults.at(fault).text(), s.harmless.text()));
  }
  loosen_others(spreads, proposal);
  return proposal;
}

std::string proposal_toml(const Proposal& proposal, const std::vector<CalibrationCase>& cases,
                          const std::string& before) {
  std::vector<int> frames;
  for (const CalibrationCase& c : cases) {
    if (frames.empty() || frames.back() != c.result.frame) frames.push_back(c.result.frame);
  }
  std::string text = fmt::format(
      "# Limits by lagomorph check --calibrate, of frames {}: between what does no harm and known faults.\n"
      "preset = \"render\"\n",
      ranges_text(frames));
  toml::table others = toml::parse(before);
  others.erase("preset");
  others.erase("limits");
  toml::table plain, tables;
  for (auto& [key, node] : others)
    (node.is_array_of_tables() || node.is_table() ? tables : plain).insert(key, node);
  const auto written = [](const toml::table& table) {
    std::ostringstream out;
    if (!table.empty()) out << toml::toml_formatter(table) << "\n";
    return out.str();
  };
  text.append(written(plain)).append("\n[limits]\n");
  for (const ProposedLimit& limit : proposal.limits) {
    text += fmt::format("{} = {}  # {}\n", limit_row(limit.name).name,
                        limit.value ? fmt::format("{}", *limit.value) : "\"off\"", limit.why);
  }
  if (!tables.empty()) text.append("\n").append(written(tables));
  return text;
}

}  // namespace lagomorph::apps
