#include "apps/preview/page_frames.h"

#include "apps/file_io.h"
#include "apps/page/html.h"
#include "apps/page/webp.h"
#include "render/png.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 6'000'000;  // of all URIs
constexpr Size png_box = {320, 320};
constexpr int png_compression = 9;

std::string small_png(const fs::path& file) {
  const render::Picture picture = opaque_picture(render::read_png(read_file(file), file.string()));
  return render::encode_png(resized(picture, size_within({picture.width, picture.height}, png_box)),
                            png_compression);
}

}  // namespace

std::vector<PageFrame> page_frames(const Shown& shown, const fs::path& work,
                                   const std::function<bool()>& stop) {
  const std::vector<const ShownFrame*> frames = shown.readable();
  if (frames.empty()) return {};
  std::vector<fs::path> files;
  files.reserve(frames.size());
  for (const ShownFrame* frame : frames) files.push_back(frame->small);
  const std::vector<std::string> encoded = webps(files, work / "page", stop);
  std::vector<PageFrame> all;
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < frames.size() && !stop(); ++i) {
    all.push_back({frames[i]->frame, encoded.empty() ? data_uri("image/png", small_png(frames[i]->small))
                                                     : data_uri("image/webp", encoded[i])});
    bytes += all.back().uri.size();
  }
  const std::size_t every = bytes / most_bytes + 1;
  if (every == 1) return all;
  // Sizes differ little from frame to frame; should the kept ones be the large ones, fewer are kept.
  for (std::size_t step = every;; ++step) {
    std::vector<PageFrame> kept;
    std::size_t size = 0;
    for (std::size_t i = 0; i < all.size(); i += step) {
      kept.push_back(all[i]);
      size += all[i].uri.size();
    }
    if (size <= most_bytes || kept.size() == 1) return kept;
  }
}

}  // namespace lagomorph::apps
