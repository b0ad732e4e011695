#include "apps/run/disk_space.h"

#include <limits>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/run/state_file.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace disk_space_test {

TEST(DiskSpace, ExpectedSizeCountsWhatIsMade) {
  render::RenderSettings render;
  render.width = 1000;
  render.height = 100;
  render.channels = {"depth"};
  const auto least = [&](const std::vector<FrameJob>& jobs) {
    return expected_size(jobs, 50, 2, render).least;
  };
  EXPECT_EQ(least({}), 0U);
  const std::size_t state = least({{0, true, false}}), both = least({{0, true, true}});
  EXPECT_GE(state, state_file_size(50, 2));
  EXPECT_GE(both, state + 400000U);
  EXPECT_EQ(least({{0, true, true}, {1, true, true}}), 2 * both);
  EXPECT_GT(expected_size({{0, true, true}}, 50, 2, render).estimate, both);
}

TEST(DiskSpace, MoreThanThereIsIsRefused) {
  const tests::TemporaryDirectory dir;
  const auto folder = dir.path() / "not" / "there" / "yet";
  EXPECT_NO_THROW(require_space(folder, {1000, 2000}));
  try {
    require_space(folder,
                  {std::numeric_limits<std::size_t>::max() / 2, std::numeric_limits<std::size_t>::max()});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::machine);
    EXPECT_TRUE(std::string(error.what()).starts_with(folder.string() + ": ")) << error.what();
  }
}

TEST(DiskSpace, SizesAsText) {
  EXPECT_EQ(size_text(0), "0 bytes");
  EXPECT_EQ(size_text(999), "999 bytes");
  EXPECT_EQ(size_text(1000), "1.0 kB");
  EXPECT_EQ(size_text(123456), "123 kB");
  EXPECT_EQ(size_text(999999), "1.0 MB");
  EXPECT_EQ(size_text(5400000000), "5.4 GB");
}

}  // namespace disk_space_test
}  // namespace lagomorph::apps
