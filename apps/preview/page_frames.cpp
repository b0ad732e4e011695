#include "apps/preview/page_frames.h"

#include <fmt/format.h>

#include "apps/file_io.h"
#include "apps/preview/html.h"
#include "apps/video/process.h"
#include "render/png.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 6'000'000;  // of all URIs
constexpr Size png_box = {320, 320};
constexpr int png_compression = 9;

/// The small pictures as WebP; none when ffmpeg cannot.
std::vector<std::string> webps(const std::vector<const ShownFrame*>& frames, const fs::path& folder,
                               const std::function<bool()>& stop) {
  make_folder(folder);
  for (std::size_t i = 0; i < frames.size(); ++i)
    link_file(frames[i]->small, folder / fmt::format("{:06}.png", i));
  std::string pattern = "file:";
  for (const char c : fs::absolute(folder).string())
    pattern += c == '%' ? std::string("%%") : std::string(1, c);
  const ProcessResult result = run_process({"ffmpeg",
                                            "-hide_banner",
                                            "-loglevel",
                                            "error",
                                            "-nostdin",
                                            "-y",
                                            "-i",
                                            pattern + "/%06d.png",
                                            "-c:v",
                                            "libwebp",
                                            "-quality",
                                            "80",
                                            "-compression_level",
                                            "3",
                                            "-threads",
                                            "1",
                                            "-f",
                                            "image2",
                                            "-start_number",
                                            "0",
                                            pattern + "/%06d.webp"},
                                           stop);
  if (!result.found || result.status != 0) return {};
  std::vector<std::string> all;
  for (std::size_t i = 0; i < frames.size(); ++i)
    all.push_back(read_file(folder / fmt::format("{:06}.webp", i)));
  return all;
}

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
  const std::vector<std::string> encoded = webps(frames, work / "page", stop);
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
