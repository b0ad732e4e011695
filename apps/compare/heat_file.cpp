#include "apps/compare/heat_file.h"

#include "apps/file_io.h"
#include "render/image_compare/magma.h"
#include "render/png.h"

namespace lagomorph::apps {

void write_heat_map(const std::filesystem::path& file, const render::ErrorMap& map) {
  make_folder(file.parent_path());
  write_file(file, render::encode_png(render::magma_picture(map), 6));
}

}  // namespace lagomorph::apps
