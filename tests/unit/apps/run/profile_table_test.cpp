#include "apps/run/profile_table.h"

#include <gtest/gtest.h>

namespace lagomorph::apps {
namespace profile_table_test {

using std::chrono::milliseconds;

TEST(ProfileTable, TellsEachThreadsStagesAndItsRest) {
  sim::Profile profile;
  profile.add(sim::Stage::gradient, milliseconds(250));
  profile.add(sim::Stage::gradient, milliseconds(250));
  profile.add(sim::Stage::simulation, milliseconds(800));
  profile.add(sim::Stage::wait_to_simulate, milliseconds(100));
  profile.add(sim::Stage::encode, milliseconds(20));
  EXPECT_EQ(profile_table(profile, 2.0),
            "thread      stage             seconds    calls   ms a call   share\n"
            "simulating  gradient            0.500        2     250.000   25.0%  ██▌\n"
            "            rest                0.300        1     300.000   15.0%  █▌\n"
            "            waiting             0.100        1     100.000    5.0%  ▌\n"
            "writing     encode              0.020        1      20.000    1.0%  ▏\n"
            "            waiting             0.000        0       0.000    0.0%  \n"
            "whole command                   2.000\n");
}

TEST(ProfileTable, IsSecondsByStageInJson) {
  sim::Profile profile;
  profile.add(sim::Stage::draw, milliseconds(1500));
  EXPECT_EQ(stage_seconds(profile).dump(), R"({"draw":1.5})");
}

}  // namespace profile_table_test
}  // namespace lagomorph::apps
