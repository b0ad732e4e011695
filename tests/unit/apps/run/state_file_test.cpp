#include "apps/run/state_file.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "apps/error.h"
#include "apps/npy.h"

namespace lagomorph::apps {
namespace state_file_test {

/// Two vertices; every number tells where it stands.
sim::State some_state(int older_levels) {
  const auto numbers = [](double first) { return sim::VecX::LinSpaced(6, first, first + 5.0).eval(); };
  sim::State state;
  state.frame = 7;
  state.t = 7 / 30.0;
  state.q = numbers(0.0);
  state.qdot = numbers(10.0);
  for (int level = 1; level <= older_levels; ++level) {
    state.history.push_back({1.0 / level, numbers(100.0 * level), numbers(100.0 * level + 10.0)});
  }
  return state;
}

std::string error_of(const std::string& bytes, int vertices = 2) {
  try {
    decode_state(bytes, "s.npy", 0, 30.0, vertices);
  } catch (const Error& error) {
    EXPECT_EQ(error.status, ExitStatus::wrong_input);
    return error.what();
  }
  return "no error";
}

TEST(StateFile, IsLevelsThenPositionsAndVelocities) {
  const NpyArray array = read_npy(encode_state(some_state(1)), "a");
  EXPECT_EQ(array.shape, (std::vector<std::size_t>{2, 2, 2, 3}));
  const auto at = [&](int level, int kind, int vertex, int axis) {
    return array.values[static_cast<std::size_t>(((level * 2 + kind) * 2 + vertex) * 3 + axis)];
  };
  EXPECT_EQ(at(0, 0, 1, 2), 5.0);
  EXPECT_EQ(at(0, 1, 0, 0), 10.0);
  EXPECT_EQ(at(1, 0, 1, 0), 103.0);
  EXPECT_EQ(at(1, 1, 0, 1), 111.0);
}

TEST(StateFile, ReadsBackBitByBit) {
  sim::State state = some_state(2);
  state.q[3] = 0.1 + 0.2;
  const sim::State read =
      decode_state(encode_state(state), "a", 7, 30.0, 2, std::array{state.history[0].t, state.history[1].t});
  EXPECT_EQ(read.frame, 7);
  EXPECT_EQ(read.t, state.t);
  EXPECT_EQ(read.q, state.q);
  EXPECT_EQ(read.qdot, state.qdot);
  ASSERT_EQ(read.history.size(), 2U);
  EXPECT_EQ(read.history[1].t, 0.5);
  EXPECT_EQ(read.history[1].q, state.history[1].q);
  EXPECT_EQ(read.history[1].qdot, state.history[1].qdot);
}

TEST(StateFile, HasTheSizeThatIsExpected) {
  EXPECT_EQ(encode_state(some_state(0)).size(), state_file_size(2, 1));
  EXPECT_EQ(encode_state(some_state(2)).size(), state_file_size(2, 3));
}

TEST(StateFile, RefusesOtherArrays) {
  const std::vector<double> values(24, 1.0);
  using Shape = std::vector<std::size_t>;
  const auto wrong = [&](const Shape& shape) {
    std::size_t n = 1;
    for (const std::size_t s : shape) n *= s;
    return error_of(npy_bytes(std::span(values).first(n), shape));
  };
  EXPECT_EQ(wrong({2, 2, 2, 3}), "no error");
  EXPECT_EQ(wrong({1, 2, 3, 3}), "s.npy: has shape (1, 2, 3, 3); (levels, 2, 2, 3) would be right");
  for (const Shape& shape :
       {Shape{24}, Shape{2, 2, 3}, Shape{1, 3, 2, 3}, Shape{1, 2, 2, 2}, Shape{0, 2, 2, 3}}) {
    EXPECT_NE(wrong(shape), "no error") << shape_text(shape);
  }
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    sim::State state = some_state(0);
    state.qdot[5] = bad;
    EXPECT_EQ(error_of(encode_state(state)), "s.npy: has a value that is not finite");
  }
}

}  // namespace state_file_test
}  // namespace lagomorph::apps
