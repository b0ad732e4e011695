#include "apps/check/heat.h"

#include <algorithm>

#include "apps/file_io.h"
#include "apps/run/paths.h"
#include "render/image_compare/magma.h"
#include "render/png.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr int gap = 4;               // columns between pictures
constexpr int heat_compression = 6;  // zlib

/// Puts a picture's rows beside what is there, from column x on.
void put(render::Picture& panel, int x, const render::Picture& picture) {
  for (int y = 0; y < picture.height; ++y) {
    std::copy_n(picture.rgb.begin() + std::ptrdiff_t{3} * y * picture.width, 3 * picture.width,
                panel.rgb.begin() + 3 * (std::ptrdiff_t{y} * panel.width + x));
  }
}

/// R, G, B in 8 bits.
render::Picture to_picture(const render::Pixels& pixels) {
  render::Picture picture{pixels.width, pixels.height, {}};
  picture.rgb.reserve(3 * pixels.pixel_count());
  const auto step = static_cast<std::size_t>(pixels.samples_per_pixel());
  const unsigned shift = pixels.bit_depth() == 16 ? 8U : 0U;
  std::visit(
      [&](const auto& samples) {
        for (std::size_t i = 0; i < samples.size(); i += step) {
          for (std::size_t c = 0; c < 3; ++c)
            picture.rgb.push_back(static_cast<std::uint8_t>(samples[i + c] >> shift));
        }
      },
      pixels.samples);
  return picture;
}

}  // namespace

void write_heat(const fs::path& out, ComparedFrame& frame) {
  const render::Picture heat = render::magma_picture(*frame.flip);
  const std::string name = frame_file(frame.result.frame, ".png");
  render::Picture panel{3 * heat.width + 2 * gap, heat.height, {}};
  panel.rgb.assign(
      std::size_t{3} * static_cast<std::size_t>(panel.width) * static_cast<std::size_t>(panel.height), 255);
  put(panel, 0, to_picture(*frame.golden));
  put(panel, heat.width + gap, to_picture(*frame.fresh));
  put(panel, 2 * (heat.width + gap), heat);
  make_folder(out / "heat");
  make_folder(out / "panels");
  write_file(out / "heat" / name, render::encode_png(heat, heat_compression));
  write_file(out / "panels" / name, render::encode_png(panel, heat_compression));
  frame.result.heat = "heat/" + name;
  frame.result.panel = "panels/" + name;
}

void remove_heat(const fs::path& out) {
  for (const char* folder : {"heat", "panels"}) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(out / folder, error)) {
      if (frame_of(entry.path(), ".png")) remove_file(entry.path());
    }
    remove_leftovers(out / folder);
  }
}

}  // namespace lagomorph::apps
