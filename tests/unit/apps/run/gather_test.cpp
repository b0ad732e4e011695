#include "apps/run/gather.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"
#include "tests/support/temporary_directory.h"
#include "tests/unit/apps/run/run_fixture.h"

namespace lagomorph::apps {
namespace gather_test {

namespace fs = std::filesystem;
using tests::read_all;

TEST(Gather, TellsOfRecordsThatMatch) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 5);
  fs::remove(paths.picture(1));
  fs::remove(paths.state(2));
  write_frame(paths, some_record(3, some_identity("999.0")));
  RunInfo info;
  info.identity = some_identity();
  info.about["name"] = "bar";
  const auto frames = gather(paths, info, 10);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_TRUE(frames.at(0).picture.has_value());
  EXPECT_FALSE(frames.at(1).picture.has_value());
  EXPECT_TRUE(frames.contains(4));

  const auto json = nlohmann::json::parse(read_all(paths.run_json()));
  EXPECT_EQ(json.at("name"), "bar");
  EXPECT_EQ(json.at("hashes").at("simulation"), some_identity().simulation_hash());
  EXPECT_EQ(json.at("hashes").at("picture"), some_identity().picture_hash());
  ASSERT_EQ(json.at("frames").size(), 3U);
  EXPECT_EQ(json.at("frames")[2].at("frame"), 4);
  EXPECT_EQ(json.at("frames")[0].at("picture_sha256"), sha256("picture 0"));
  EXPECT_EQ(gather(paths, info, 4).size(), 2U) << "frames that the scene has not are left out";
}

TEST(Gather, EnergyHasARowAFrameWithSeventeenDigits) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  write_run(paths, 2);
  RunInfo info;
  info.identity = some_identity();
  gather(paths, info, 2);
  EXPECT_EQ(read_all(paths.energy()),
            "frame,time,kinetic,elastic,gravitational,total,mass,momentum_x,momentum_y,momentum_z,newton_"
            "iterations,"
            "residual,work_pins,work_loads,pin_force_x,pin_force_y,pin_force_z,angular_momentum_x,"
            "angular_momentum_y,angular_momentum_z,min_J,steps,rejected,damping_loss\n"
            "0,0,0.10000000000000001,0.25,-0.5,-0.15000000000000002,24,1.5,-2.5,0.33333333333333331,17,"
            "1.0000000000000001e-09,0,-0.29999999999999999,4.1428571428571432,7,-3,-0.5,0.25,"
            "0.66666666666666663,0.875,4,2,0.125\n"
            "1,0.033333333333333333,1.1000000000000001,0.25,-0.5,0.85000000000000009,24,1.5,-2.5,"
            "0.33333333333333331,17,1.0000000000000001e-09,0.10000000000000001,-0.59999999999999998,"
            "4.1428571428571432,7,-3,-0.5,0.25,0.66666666666666663,0.875,4,2,0.25\n");
  EXPECT_FALSE(fs::exists(paths.newton()));
}

TEST(RunJson, ReadsBack) {
  const tests::TemporaryDirectory dir;
  const RunPaths paths(dir.path());
  EXPECT_FALSE(read_run_info(paths).has_value());
  RunInfo info;
  info.identity = some_identity();
  info.about["name"] = "bar";
  info.about["mesh"] = {{"vertices", 27}};
  info.video = {"bar.mp4", 1, 3, "source", "hash"};
  write_file(paths.run_json(), run_json_text(info, {{0, some_record(0)}}));
  const auto read = read_run_info(paths);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->identity.picture_hash(), info.identity.picture_hash());
  EXPECT_EQ(read->identity.state_maker(), info.identity.state_maker());
  EXPECT_EQ(read->about, info.about);
  ASSERT_TRUE(read->video.has_value());
  EXPECT_EQ(read->video->source, "source");
  EXPECT_EQ(run_json_text(*read, {{0, some_record(0)}}), read_all(paths.run_json()));
}

}  // namespace gather_test
}  // namespace lagomorph::apps
