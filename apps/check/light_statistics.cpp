#include "apps/check/light_statistics.h"

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/npy.h"
#include "render/channels.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

fs::path channel_beside(const fs::path& picture, std::string_view channel) {
  const fs::path folder = picture.parent_path();
  const fs::path root = folder.filename() == "frames" ? folder.parent_path() : folder;
  return root / "aov" / channel / picture.filename().replace_extension(".npy");
}

std::optional<render::LightStatistics> read_light_statistics(const fs::path& picture, int width, int height) {
  const fs::path file = channel_beside(picture, render::statistics_channel);
  if (std::error_code none; !fs::exists(file, none)) return std::nullopt;
  NpyFloats array = read_npy_floats(read_file(file), file.string());
  render::LightStatistics statistics{width, height, {}};
  const std::size_t shape[] = {static_cast<std::size_t>(statistics.rows()),
                               static_cast<std::size_t>(statistics.columns()),
                               std::size_t{render::statistics_components}};
  if (!std::equal(array.shape.begin(), array.shape.end(), std::begin(shape), std::end(shape))) {
    wrong_input(fmt::format("{}: has the shape {}; {} would be right for a picture of {}x{}", file.string(),
                            shape_text(array.shape), shape_text(shape), width, height));
  }
  statistics.values = std::move(array.values);
  return statistics;
}

}  // namespace lagomorph::apps
