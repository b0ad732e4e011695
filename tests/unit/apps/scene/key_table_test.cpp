#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "apps/scene/scene.h"
#include "tests/support/paths.h"

namespace lagomorph::apps {
namespace key_table_test {

TEST(KeyTable, HasARowAKey) {
  const std::string table = scene_key_table_markdown();
  for (const char* row : {
           "| Key | Default | Unit | Valid | Meaning |\n",
           "| `time.fps` | `30.0` | 1/s | > 0 | frames a second; frame k is at t = k / fps |\n",
           "| `body.N.mesh` | required |",
           "| `body.N.pin.N.sphere.radius` | required | m | >= 0 |",
           "| `camera.orthographic` | none | m | > 0 |",
           "| `render.backend` | `\"raster\"` |  | `raster`, `path` |",
           "| `render.raster.multisample` | `4` |  | 1 or 4 |",
           "| `light.N.size` | `[1.5, 1.5]` | m | > 0 |",
       }) {
    EXPECT_NE(table.find(row), std::string::npos) << row << "\nin\n" << table;
  }
}

TEST(KeyTable, StandsInTheReadme) {
  std::ifstream file(lagomorph::tests::source_dir() / "README.md");
  if (!file) GTEST_SKIP() << "there is no README.md";
  std::stringstream text;
  text << file.rdbuf();
  const std::string readme = text.str(), begin = "<!-- scene keys -->\n", end = "<!-- /scene keys -->";
  const std::size_t from = readme.find(begin), to = readme.find(end);
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(readme.substr(from + begin.size(), to - from - begin.size()), scene_key_table_markdown())
      << "paste what `lagomorph info --keys` prints between the markers";
}

}  // namespace key_table_test
}  // namespace lagomorph::apps
