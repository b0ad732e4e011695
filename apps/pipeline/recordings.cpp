#include "apps/pipeline/recordings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/npy.h"

namespace lagomorph::apps {
namespace {

NpyArray read_finite(const std::filesystem::path& file) {
  NpyArray array = read_npy(read_file(file), file.string());
  const auto bad =
      std::find_if(array.values.begin(), array.values.end(), [](double x) { return !std::isfinite(x); });
  if (bad != array.values.end())
    wrong_input(fmt::format("{}: has a value that is not finite", file.string()));
  return array;
}

[[noreturn]] void wrong_shape(const std::filesystem::path& file, const NpyArray& array,
                              const std::string& right) {
  wrong_input(
      fmt::format("{}: has shape {}; {} would be right", file.string(), shape_text(array.shape), right));
}

}  // namespace

sim::Recording read_path(const std::filesystem::path& file, std::size_t vertices) {
  NpyArray array = read_finite(file);
  const std::vector<std::size_t>& shape = array.shape;
  const bool shared = shape.size() == 2 && shape[1] == 3;
  const bool each = shape.size() == 3 && shape[1] == vertices && shape[2] == 3;
  if ((!shared && !each) || shape[0] == 0)
    wrong_shape(file, array, fmt::format("(T, 3) or (T, {}, 3) with T >= 1", vertices));
  return {static_cast<int>(shape[0]), shared ? 0 : static_cast<int>(vertices), std::move(array.values)};
}

sim::Points read_velocities(const std::filesystem::path& file, Eigen::Index vertices) {
  const NpyArray array = read_finite(file);
  const std::array<std::size_t, 2> right = {static_cast<std::size_t>(vertices), 3};
  if (!std::equal(array.shape.begin(), array.shape.end(), right.begin(), right.end()))
    wrong_shape(file, array, shape_text(right));
  return Eigen::Map<const sim::Points>(array.values.data(), vertices, 3);
}

}  // namespace lagomorph::apps
