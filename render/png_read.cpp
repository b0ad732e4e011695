#include "render/png_read.h"

#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>

#include <png.h>

namespace lagomorph::render {
namespace {

/// What libpng's callbacks see; it outlives every jump.
struct Job {
  std::string_view bytes;
  std::size_t at = 0;
  bool sixteen_bits = false;
  png_bytepp rows = nullptr;
  std::size_t row_bytes = 0;
  char message[160] = {};
};

void on_error(png_structp png, png_const_charp message) {
  auto* job = static_cast<Job*>(png_get_error_ptr(png));
  std::strncpy(job->message, message, sizeof job->message - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep out, std::size_t count) {
  auto* job = static_cast<Job*>(png_get_io_ptr(png));
  if (count > job->bytes.size() - job->at) png_error(png, "data end early");
  std::memcpy(out, job->bytes.data() + job->at, count);
  job->at += count;
}

/// Between setjmp and its jumps stands nothing that has a destructor.
bool decode(png_structp png, png_infop info, Job& job) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, &job, on_read);
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);             // the header has been checked
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // texts, profiles, gamma
  png_read_info(png, info);
  png_set_expand(png);
  png_set_gray_to_rgb(png);
  if (job.sixteen_bits && std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != job.row_bytes)
    png_error(png, "its rows are of another length than its header says");
  png_read_image(png, job.rows);
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

Pixels read_png(std::string_view bytes, const std::string& name) {
  const PngHeader header = read_png_header(bytes, name);
  Pixels pixels{.width = header.width,
                .height = header.height,
                .channels = header.channels,
                .alpha = header.alpha,
                .samples = {}};
  if (header.bit_depth == 16) pixels.samples.emplace<1>();
  std::vector<png_bytep> rows(static_cast<std::size_t>(header.height));
  Job job{.bytes = bytes, .sixteen_bits = header.bit_depth == 16, .rows = rows.data()};
  std::visit(
      [&](auto& samples) {
        const auto row =
            static_cast<std::size_t>(header.width) * static_cast<std::size_t>(pixels.samples_per_pixel());
        samples.resize(row * rows.size());
        job.row_bytes = row * sizeof samples[0];
        for (std::size_t y = 0; y < rows.size(); ++y)
          rows[y] = reinterpret_cast<png_bytep>(samples.data() + y * row);
      },
      pixels.samples);

  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
  if (png == nullptr) throw std::bad_alloc();
  png_infop info = png_create_info_struct(png);
  const bool decoded = info != nullptr && decode(png, info, job);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!decoded && job.message[0] == '\0') throw std::bad_alloc();
  if (!decoded) throw PictureError(name + ": is damaged: " + job.message);
  return pixels;
}

}  // namespace lagomorph::render
