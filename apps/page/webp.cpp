#include "apps/page/webp.h"

#include <fmt/format.h>

#include "apps/file_io.h"
#include "apps/video/process.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

std::vector<std::string> webps(const std::vector<fs::path>& pngs, const fs::path& folder,
                               const std::function<bool()>& stop) {
  make_folder(folder);
  for (std::size_t i = 0; i < pngs.size(); ++i) link_file(pngs[i], folder / fmt::format("{:06}.png", i));
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
  for (std::size_t i = 0; i < pngs.size(); ++i)
    all.push_back(read_file(folder / fmt::format("{:06}.webp", i)));
  return all;
}

}  // namespace lagomorph::apps
