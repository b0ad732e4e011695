#include "apps/pipeline/painted_fields.h"

#include <utility>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/npy.h"

namespace lagomorph::apps {

void read_painted(const std::filesystem::path& directory, sim::FieldSettings& field) {
  if (field.file.empty()) return;
  const std::string origin = fmt::format("{}: {}", field.where, field.file);
  NpyArray array = read_npy(read_file(directory / field.file), origin);
  if (array.shape.size() != 1 || array.values.empty()) {
    wrong_input(fmt::format("{}: has shape {}; one value a tet, or one a vertex, would be right", origin,
                            shape_text(array.shape)));
  }
  field.painted = std::move(array.values);
}

}  // namespace lagomorph::apps
