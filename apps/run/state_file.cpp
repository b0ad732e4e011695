#include "apps/run/state_file.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/npy.h"

namespace lagomorph::apps {
namespace {

void append(std::vector<double>& values, const sim::VecX& v) {
  values.insert(values.end(), v.data(), v.data() + v.size());
}

}  // namespace

std::string encode_state(const sim::State& state) {
  const std::size_t n = static_cast<std::size_t>(state.q.size());
  const std::size_t levels = 1 + state.history.size();
  std::vector<double> values;
  values.reserve(levels * 2 * n);
  append(values, state.q);
  append(values, state.qdot);
  for (const sim::State::Level& level : state.history) {
    append(values, level.q);
    append(values, level.qdot);
  }
  return npy_bytes(values, std::array<std::size_t, 4>{levels, 2, n / 3, 3});
}

sim::State decode_state(std::string_view bytes, const std::string& origin, int frame, double fps,
                        int vertices, std::span<const double> history_times) {
  const NpyArray array = read_npy(bytes, origin);
  const std::vector<std::size_t>& shape = array.shape;
  if (shape.size() != 4 || shape[0] < 1 || shape[1] != 2 || shape[2] != static_cast<std::size_t>(vertices) ||
      shape[3] != 3) {
    throw Error(ExitStatus::wrong_input, origin + ": has shape " + shape_text(shape) + "; (levels, 2, " +
                                             std::to_string(vertices) + ", 3) would be right");
  }
  for (const double value : array.values) {
    if (!std::isfinite(value))
      throw Error(ExitStatus::wrong_input, origin + ": has a value that is not finite");
  }
  const Eigen::Index n = 3 * static_cast<Eigen::Index>(vertices);
  const double* next = array.values.data();
  const auto take = [&]() -> sim::VecX {
    const double* begin = next;
    next += n;
    return Eigen::Map<const sim::VecX>(begin, n);
  };
  sim::State state;
  state.frame = frame;
  state.t = frame / fps;
  state.q = take();
  state.qdot = take();
  for (std::size_t level = 1; level < shape[0]; ++level) {
    sim::State::Level older;
    older.t =
        level <= history_times.size() ? history_times[level - 1] : std::numeric_limits<double>::quiet_NaN();
    older.q = take();
    older.qdot = take();
    state.history.push_back(std::move(older));
  }
  return state;
}

sim::State read_state(const std::filesystem::path& file, int frame, double fps, int vertices,
                      std::span<const double> history_times) {
  return decode_state(read_file(file), file.string(), frame, fps, vertices, history_times);
}

std::size_t state_file_size(int vertices, int levels) {
  return 128 + static_cast<std::size_t>(levels) * 2 * static_cast<std::size_t>(vertices) * 3 * sizeof(double);
}

}  // namespace lagomorph::apps
