#include "render/raster/still_picture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/raster/pixel_ray.h"
#include "render/raster/shaders/shaders.h"

namespace lagomorph::render::raster {
namespace {

/// Of the ground, from which on no highlight on it is narrower than some cells.
constexpr float least_roughness = 0.15F;
constexpr int tiles_beside = 16;  // in the square that they are drawn to, see tiles_vertex
constexpr int most_tiles = tiles_beside * tiles_beside;

std::string still_definitions(const LightFeatures& features, int lights) {
  return features.definitions() + "#define LIGHTS " + std::to_string(lights) + "\n";
}

/// In the middle of pixels (x + 1/2, y + 1/2) of the cells' target is the corner of cell (x, y).
std::string cell_definitions() {
  const std::string side = std::to_string(still_cell) + ".0";
  return "#define CELLS\n#define AT_PIXEL (" + side + " * (gl_FragCoord.xy - 0.5))\n";
}

constexpr const char* tile_definitions =
    "flat in vec2 tile_offset;\n#define AT_PIXEL (gl_FragCoord.xy + tile_offset)\n";

void texture_2d(const Texture& texture, GLenum format, int width, int height) {
  glActiveTexture(GL_TEXTURE14);  // the maps are bound to their own
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
}

/// Rows from y on of the bound target's.
void read_attachment(std::size_t number, int y, int width, int height, GLenum type, void* to) {
  glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(number));
  glReadPixels(0, y, width, height, GL_RGBA, type, to);
}

}  // namespace

StillPicture::StillPicture(const LightFeatures& features, int lights)
    : features_(features),
      cells_program_(
          "still cells", {shaders::full_screen_vertex},
          {cell_definitions().c_str(), still_definitions(features, lights).c_str(), shaders::frame,
           shaders::brdf, shaders::sky, shaders::shade, shaders::ground_point, shaders::still_fragment}),
      light_program_("ground's light", {shaders::full_screen_vertex},
                     {still_definitions(features, lights).c_str(), shaders::frame, shaders::brdf,
                      shaders::sky, shaders::shade, shaders::ground_point, shaders::ground_light_fragment}) {
  still_.lights = lights;
}

StillPicture::Target::Target(int w, int h, std::size_t count, GLenum parts_format) : width(w), height(h) {
  texture_2d(picture, GL_RGBA32F, w, h);
  glBindTexture(GL_TEXTURE_2D_ARRAY, parts.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, parts_format, w, h, static_cast<GLsizei>(count));
  bind(target, w, h);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.id(), 0);
  std::vector<GLenum> buffers = {GL_COLOR_ATTACHMENT0};
  for (std::size_t i = 0; i < count; ++i) {
    buffers.push_back(GL_COLOR_ATTACHMENT1 + static_cast<GLenum>(i));
    glFramebufferTextureLayer(GL_FRAMEBUFFER, buffers.back(), parts.id(), 0, static_cast<GLint>(i));
  }
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  check_framebuffer("still picture");
}

StillPicture::BackdropTarget::BackdropTarget(int width, int height) {
  texture_2d(texture, GL_RGBA32F, width, height);
  bind(target, width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  check_framebuffer("backdrop");
}

void StillPicture::set_ground(const SurfaceBlock& ground) {
  const float roughness = ground.finish[0], metallic = ground.finish[1];
  // What a metal sends is not linear in its colour.
  each_pixel_ = roughness < least_roughness || (has_texture() && metallic > 0.0F);
  forget();
}

const StillParts& StillPicture::draw(const FrameBlock& frame, std::span<const TileRun> runs) {
  const View view = {frame.eye, frame.forward, frame.right, frame.up, frame.viewport, frame.sky_picture};
  if (!(seen_by_ == view)) {
    draw_picture(frame);
    seen_by_ = view;
  }
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t i) {
    const TileRun& run = runs[i];
    const int y = static_cast<int>(run.lower) / tile_size;
    for (int x = static_cast<int>(run.left) / tile_size; x < static_cast<int>(run.right) / tile_size; ++x) {
      const int number = y * cells_.tile_columns() + x;
      const auto tile = static_cast<std::size_t>(number);
      if (has_planes_[tile] != 0) continue;
      fill_planes(frame, cells_, tiles_[tile], x, y, backdrop_, still_);
      has_planes_[tile] = 1;
    }
  });
  return still_;
}

void StillPicture::draw_picture(const FrameBlock& frame) {
  const int width = static_cast<int>(frame.viewport.x()), height = static_cast<int>(frame.viewport.y());
  if (still_.width != width || still_.height != height) {
    cells_target_.reset();
    backdrop_target_.reset();
    still_.width = width, still_.height = height;
    still_.picture.resize(3 * still_.pixels());
    still_.planes = std::make_unique_for_overwrite<std::uint16_t[]>(still_.plane_count() * still_.pixels());
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glBindVertexArray(no_attributes_.id());
  draw_cells();
  tiles_ = still_tiles(frame, cells_, each_pixel_);
  has_planes_.assign(tiles_.size(), 0);
  draw_backdrop(frame);
  fill_picture(frame, cells_, tiles_, backdrop_, still_);
  draw_tiles();
  if (const bool below = ground_is_below(frame); light_of_ground_below_ != below) {
    draw_light();
    light_of_ground_below_ = below;
  }
}

void StillPicture::draw_cells() {
  const auto corners = [](int pixels) {
    return (pixels + tile_size - 1) / tile_size * still_cells_of_tile + 1;
  };
  cells_.columns = corners(still_.width), cells_.rows = corners(still_.height);
  if (!cells_target_) cells_target_.emplace(cells_.columns, cells_.rows, still_.part_count(), GL_RGBA32F);
  const Target& to = *cells_target_;
  cells_program_.use();
  const std::size_t count = cells_.corners();
  values_.resize(4 * count);
  cells_.met.resize(count);
  for (std::size_t set = 0; set < (has_texture() ? 2 : 1); ++set) {
    bind(to.target, to.width, to.height);
    glUniform1i(cells_program_.location("in_texture_color"), set == 1 ? 1 : 0);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<float>& planes = cells_.planes[set];
    planes.resize((3 + still_.plane_count()) * count);
    float* plane = planes.data();
    for (std::size_t part = 0; part < 1 + still_.part_count(); ++part) {
      read_attachment(part, 0, to.width, to.height, GL_FLOAT, values_.data());
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < count; ++k) plane[k] = values_[4 * k + c];
        plane += count;
      }
      if (part > 0) continue;
      for (std::size_t k = 0; k < count; ++k) cells_.met[k] = values_[4 * k + 3] > 0.5F ? 1 : 0;
    }
  }
}

/// In the rows where it is needed.
void StillPicture::draw_backdrop(const FrameBlock& frame) {
  const bool is_constant = frame.background.w() > 0.5F;
  int first = still_.height, last = 0;
  for (std::size_t k = 0; k < tiles_.size(); ++k) {
    const bool shows = !is_constant && (tiles_[k] == StillTile::background || tiles_[k] == StillTile::fading);
    const bool textured = has_texture() && (tiles_[k] == StillTile::fading || tiles_[k] == StillTile::solid);
    if (!shows && !textured) continue;
    const int row = static_cast<int>(k) / cells_.tile_columns();
    first = std::min(first, row * tile_size);
    last = std::min((row + 1) * tile_size, still_.height);
  }
  if (first >= last) return;
  if (!backdrop_target_) {
    backdrop_target_.emplace(still_.width, still_.height);
    backdrop_.resize(4 * still_.pixels());
  }
  if (!backdrop_program_) {
    using Parts = Program::Parts;
    backdrop_program_.emplace(
        "backdrop", Parts{shaders::full_screen_vertex},
        Parts{features_.definitions().c_str(), shaders::frame, shaders::sky, shaders::ground_point,
              shaders::ground_color, shaders::backdrop_fragment});
  }
  bind(backdrop_target_->target, still_.width, still_.height);
  glScissor(0, first, still_.width, last - first);
  glEnable(GL_SCISSOR_TEST);
  backdrop_program_->use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
  const std::size_t offset = 4 * static_cast<std::size_t>(first) * static_cast<std::size_t>(still_.width);
  read_attachment(0, first, still_.width, last - first, GL_FLOAT, backdrop_.data() + offset);
}

/// Those that are drawn pixel by pixel.
void StillPicture::draw_tiles() {
  std::vector<int> numbers;
  for (std::size_t k = 0; k < tiles_.size(); ++k) {
    if (tiles_[k] == StillTile::each_pixel) numbers.push_back(static_cast<int>(k));
  }
  if (numbers.empty()) return;
  constexpr int size = tiles_beside * tile_size;
  if (!tiles_target_) tiles_target_.emplace(size, size, still_.part_count(), GL_RGBA16F);
  if (!tiles_program_) {
    using Parts = Program::Parts;
    tiles_program_.emplace(
        "still tiles",
        Parts{("#define TILE " + std::to_string(tile_size) + ".0\n").c_str(), shaders::tiles_vertex},
        Parts{tile_definitions, still_definitions(features_, still_.lights).c_str(), shaders::frame,
              shaders::brdf, shaders::sky, shaders::shade, shaders::ground_point, shaders::ground_color,
              shaders::still_fragment});
  }
  for (std::size_t first = 0; first < numbers.size(); first += most_tiles) {
    const std::span<const int> some =
        std::span(numbers).subspan(first, std::min<std::size_t>(most_tiles, numbers.size() - first));
    std::vector<GLint> at;
    for (const int number : some) {
      at.push_back(number % cells_.tile_columns());
      at.push_back(number / cells_.tile_columns());
    }
    bind(tiles_target_->target, size, size);
    tiles_program_->use();
    glUniform2iv(tiles_program_->location("tiles"), static_cast<GLsizei>(some.size()), at.data());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(some.size()));
    read_tiles(some);
  }
}

/// Where they belong in the picture and the planes.
void StillPicture::read_tiles(std::span<const int> numbers) {
  constexpr int width = tiles_beside * tile_size;
  const int height = (static_cast<int>(numbers.size()) + tiles_beside - 1) / tiles_beside * tile_size;
  const std::size_t drawn = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  /// Calls put(from, to) with each pixel's place among those drawn and in the picture.
  const auto for_pixels = [&](const auto& put) {
    tbb::parallel_for(std::size_t{0}, numbers.size(), [&](std::size_t slot) {
      const int number = numbers[slot], beside = static_cast<int>(slot);
      const int x = number % cells_.tile_columns() * tile_size,
                y = number / cells_.tile_columns() * tile_size;
      const int from_x = beside % tiles_beside * tile_size, from_y = beside / tiles_beside * tile_size;
      for (int j = 0; j < std::min(tile_size, still_.height - y); ++j) {
        for (int i = 0; i < std::min(tile_size, still_.width - x); ++i) {
          const int from = (from_y + j) * width + from_x + i, to = (y + j) * still_.width + x + i;
          put(static_cast<std::size_t>(from), static_cast<std::size_t>(to));
        }
      }
    });
  };
  values_.resize(4 * drawn);
  read_attachment(0, 0, width, height, GL_FLOAT, values_.data());
  for_pixels([&](std::size_t from, std::size_t to) {
    std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(4 * from), 3,
                still_.picture.begin() + static_cast<std::ptrdiff_t>(3 * to));
  });
  halves_.resize(4 * drawn);
  std::uint16_t* plane = still_.planes.get();
  for (std::size_t part = 0; part < still_.part_count(); ++part) {
    read_attachment(1 + part, 0, width, height, GL_HALF_FLOAT, halves_.data());
    for_pixels([&](std::size_t from, std::size_t to) {
      for (std::size_t c = 0; c < 3; ++c) plane[c * still_.pixels() + to] = halves_[4 * from + c];
    });
    plane += 3 * still_.pixels();
  }
  for (const int number : numbers) has_planes_[static_cast<std::size_t>(number)] = 1;
}

/// On the side of the ground that is seen, with nothing before it; it is the same everywhere.
void StillPicture::draw_light() {
  const std::array<Texture, 2> light;
  const Framebuffer target;
  bind(target, 1, 1);
  for (const GLenum k : {0U, 1U}) {
    texture_2d(light[k], GL_RGBA32F, 1, 1);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + k, GL_TEXTURE_2D, light[k].id(), 0);
  }
  constexpr std::array<GLenum, 2> buffers = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(2, buffers.data());
  check_framebuffer("ground's light");
  light_program_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  const std::array<Color*, 2> to = {&still_.open, &still_.from_below};
  for (const std::size_t k : {0U, 1U}) {
    std::array<float, 4> value{};
    read_attachment(k, 0, 1, 1, GL_FLOAT, value.data());
    *to[k] = Color(value[0], value[1], value[2]);
  }
}

}  // namespace lagomorph::render::raster
