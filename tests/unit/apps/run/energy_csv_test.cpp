#include "apps/run/energy_csv.h"

#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/apps/run/run_fixture.h"

namespace lagomorph::apps {
namespace energy_csv_test {

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) all.push_back(field);
  return all;
}

TEST(EnergyCsv, AddsUpTheWorksAndTheForcesOfThePins) {
  std::istringstream lines(energy_csv({{0, some_record(0)}, {1, some_record(1)}, {2, some_record(2)}}));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = fields(line);
  const auto column = [&](const std::vector<std::string>& row, const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) throw std::runtime_error("no column " + name);
    return std::stod(row.at(static_cast<std::size_t>(at - names.begin())));
  };
  double work_pins = 0.0, work_loads = 0.0;
  for (int frame = 0; frame <= 2; ++frame) {
    ASSERT_TRUE(std::getline(lines, line));
    const std::vector<std::string> row = fields(line);
    EXPECT_EQ(row.size(), names.size());
    work_pins += 0.1 * frame;
    work_loads += -0.3;
    EXPECT_EQ(column(row, "work_pins"), work_pins);
    EXPECT_EQ(column(row, "work_loads"), work_loads);
    EXPECT_EQ(column(row, "pin_force_x"), 1.0 / 7.0 + 4.0);
    EXPECT_EQ(column(row, "pin_force_y"), 7.0);
    EXPECT_EQ(column(row, "pin_force_z"), -3.0);
    EXPECT_EQ(column(row, "angular_momentum_z"), 2.0 / 3.0);
    EXPECT_EQ(column(row, "min_J"), 0.875);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

}  // namespace energy_csv_test
}  // namespace lagomorph::apps
