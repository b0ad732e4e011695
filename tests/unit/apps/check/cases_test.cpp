#include <array>
#include <string_view>

#include "tests/support/check_fixture.h"
#include "tests/support/paths.h"

/// The list of cases that tell a check's worth: what nobody sees passes by the defaults, what one looks for
/// fails.
namespace lagomorph::tests {
namespace cases_test {

struct Case {
  const char* name;
  std::string golden, fresh;        // PNG files
  std::vector<std::string> passes;  // presets
};

std::vector<Case> cases() {
  std::uint32_t state = 5;
  const auto random = [&state] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>((state >> 16U) % 3U) - 1;
  };
  const std::string spheres = flip_file("spheres_ref.png");
  const auto with = [&](const auto& change) { return changed_png("spheres_ref.png", change); };
  const std::string bunny_file =
      lagomorph::tests::source_dir().string() + "/tests/golden/bunny_path/frames/frame_0002.png";
  const std::string bunny = read_all(bunny_file);
  const auto of_bunny = [&](const auto& change) { return changed(bunny, change); };
  return {
      {"equal", spheres, spheres, {"exact", "lsb", "render", "mc"}},
      {"recompressed",
       spheres,
       with([](double v, std::size_t) { return v; }),
       {"exact", "lsb", "render", "mc"}},
      {"plus_minus_1",
       spheres,
       with([&](double v, std::size_t) { return v + random(); }),
       {"lsb", "render", "mc"}},
      {"plus_1", spheres, with([](double v, std::size_t) { return v + 1; }), {"lsb", "render", "mc"}},
      {"anti_aliasing", flip_file("edge_ref.png"), flip_file("edge_aa.png"), {"render", "mc"}},
      {"256_samples", spheres, flip_file("spheres_mc256.png"), {"render", "mc"}},
      {"16_samples", spheres, flip_file("spheres_mc16.png"), {"mc"}},
      {"missing", spheres, flip_file("spheres_missing.png"), {}},
      {"moved", spheres, flip_file("spheres_moved.png"), {}},
      {"gamma", spheres, with([](double v, std::size_t) { return 255 * std::pow(v / 255, 1 / 1.1); }), {}},
      {"cast", spheres, with([](double v, std::size_t i) { return i % 3 == 2 ? 0.85 * v : v; }), {}},
      {"shifted", spheres, shifted_png("spheres_ref.png", 1, 0), {}},
      {"black_white", flip_file("black.png"), flip_file("white.png"), {}},
      {"bunny_plus_minus_1",
       bunny,
       of_bunny([&](double v, std::size_t) { return v + random(); }),
       {"lsb", "render", "mc"}},
      {"bunny_plus_1", bunny, of_bunny([](double v, std::size_t) { return v + 1; }), {"lsb", "render", "mc"}},
      {"bunny_gamma",
       bunny,
       of_bunny([](double v, std::size_t) { return 255 * std::pow(v / 255, 1 / 1.1); }),
       {}},
      {"bunny_cast", bunny, of_bunny([](double v, std::size_t i) { return i % 3 == 2 ? 0.85 * v : v; }), {}},
      {"other_colour", flip_file("blue.png"), flip_file("green.png"), {}},
  };
}

/// Apart from the pictures: every run of any test registers this one, and would make them.
constexpr std::array names = {"equal",         "recompressed",
                              "plus_minus_1",  "plus_1",
                              "anti_aliasing", "256_samples",
                              "16_samples",    "missing",
                              "moved",         "gamma",
                              "cast",          "shifted",
                              "black_white",   "bunny_plus_minus_1",
                              "bunny_plus_1",  "bunny_gamma",
                              "bunny_cast",    "other_colour"};

class CheckCases : public CheckFixture, public testing::WithParamInterface<const char*> {};

TEST_P(CheckCases, AreSortedRightly) {
  const std::vector<Case> all = cases();
  ASSERT_EQ(all.size(), names.size());
  const auto found = std::find_if(all.begin(), all.end(),
                                  [](const Case& c) { return std::string_view(c.name) == GetParam(); });
  ASSERT_NE(found, all.end());
  const Case& c = *found;
  add_golden(0, c.golden);
  add_run(0, c.fresh);
  for (const std::string preset : {"exact", "lsb", "render", "mc"}) {
    const bool passes = std::find(c.passes.begin(), c.passes.end(), preset) != c.passes.end();
    const Ended ended = check({"--preset", preset});
    EXPECT_EQ(ended.status, passes ? 0 : 1) << c.name << " by " << preset << "\n" << ended.out << ended.err;
    if (preset == "render") {  // the default
      EXPECT_EQ(check().status, ended.status) << c.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, CheckCases, testing::ValuesIn(names),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace cases_test
}  // namespace lagomorph::tests
