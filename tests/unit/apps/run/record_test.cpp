#include "apps/run/record.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/run/newton_csv.h"
#include "tests/support/temporary_directory.h"
#include "tests/unit/apps/run/run_fixture.h"

namespace lagomorph::apps {
namespace record_test {

TEST(Record, ReadsBackWhatWasWritten) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  make_folder(paths.records());
  write_record(paths, some_record(3));
  write_record(paths, some_record(12, some_identity(), false));
  const auto records = read_records(paths);
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(to_json(records.at(3)), to_json(some_record(3)));
  EXPECT_EQ(to_json(records.at(12)), to_json(some_record(12, some_identity(), false)));
  EXPECT_FALSE(records.at(12).picture.has_value());
  EXPECT_EQ(records.at(3).picture->ranges, some_record(3).picture->ranges);
  EXPECT_EQ(records.at(3).state->momentum, some_record(3).state->momentum);
  EXPECT_EQ(records.at(3).state->report.residual, 1e-9);
  EXPECT_TRUE(records.at(3).state->report.hit_rounding_floor);
}

TEST(Record, TellsTheContractsFigures) {
  const auto json = to_json(some_record(3));
  EXPECT_EQ(json.at("frame"), 3);
  EXPECT_EQ(json.at("time"), 0.1);
  EXPECT_EQ(json.at("state_sha256"), sha256("state 3"));
  EXPECT_EQ(json.at("picture_sha256"), sha256("picture 3"));
  EXPECT_EQ(json.at("newton_iterations"), 17);
  EXPECT_EQ(json.at("residual"), 1e-9);
  EXPECT_EQ(json.at("seconds"),
            (nlohmann::ordered_json{{"simulation", 0.25}, {"rendering", 0.5}, {"writing", 0.125}}));
}

/// A number that is not finite, as of a first guess that is inverted, comes back as NaN.
TEST(Record, KeepsTheLogOfNewton) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  make_folder(paths.records());
  FrameRecord record = some_record(3);
  record.state->report.newton = {
      {0.1, 0.025, sim::StepStatus::not_finite, {{0.5, std::numeric_limits<double>::infinity(), 0.0, 0.0}}},
      {0.1, 0.0125, sim::StepStatus::converged, {{0.5, -2.0, 0.0, 0.0}, {1e-9, -3.0, 0.5, 0.25}}}};
  write_record(paths, record);
  const auto records = read_records(paths);
  ASSERT_EQ(records.size(), 1U);
  const std::string rows = newton_csv(records);
  EXPECT_EQ(rows,
            "frame,time,h,status,iteration,residual,energy,step,clamping\n"
            "3,0.10000000000000001,0.025000000000000001,not_finite,0,0.5,nan,0,0\n"
            "3,0.10000000000000001,0.012500000000000001,converged,0,0.5,-2,0,0\n"
            "3,0.10000000000000001,0.012500000000000001,converged,1,1.0000000000000001e-09,-3,0.5,0.25\n");
  EXPECT_EQ(newton_csv({{3, some_record(3)}}), "");
}

TEST(Record, WhatIsNoRecordIsLeftOut) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  EXPECT_TRUE(read_records(paths).empty());
  make_folder(paths.records());
  const std::string whole = to_json(some_record(3)).dump();
  dir.write("records/frame_0003.json", whole);
  dir.write("records/frame_0004.json", whole);  // another frame's
  dir.write("records/frame_0005.json", whole.substr(0, whole.size() / 2));
  dir.write("records/frame_0006.json", "");
  dir.write("records/frame_0007.json", "[1, 2]");
  dir.write("records/frame_0008.json", "{\"frame\": 8, \"seconds\": {}, \"state_sha256\": 5}");
  dir.write("records/notes.json", whole);
  const auto records = read_records(paths);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_TRUE(records.contains(3));
}

}  // namespace record_test
}  // namespace lagomorph::apps
