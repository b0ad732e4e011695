#include "apps/preview/animation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/file_io.h"
#include "apps/one_line.h"
#include "apps/video/process.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr double slowest_rate = 10.0;  // [1/s]; slower is no motion: what is thinned out further plays faster
constexpr std::size_t most_gif_frames = 120;
constexpr Size gif_box = {320, 320};

/// Pictures of one animation and how fast they go.
struct Reel {
  std::vector<const ShownFrame*> frames;
  double rate = 0;
};

/// Of the readable ones so many that there are at most `most` and, about, `rate` a second.
Reel reel_of(const PreviewMaterial& m, const Shown& shown, std::size_t most, double rate) {
  const std::vector<const ShownFrame*> all = shown.readable();
  const double there = picture_rate(m) / shown.every;
  const auto every = static_cast<std::size_t>(
      std::max({1.0, std::round(there / rate),
                std::ceil(static_cast<double>(all.size()) / static_cast<double>(most))}));
  Reel reel{.frames = {},
            .rate = every == 1 ? there
                               : std::max(there / static_cast<double>(every), std::min(there, slowest_rate))};
  for (std::size_t i = 0; i < all.size(); i += every) reel.frames.push_back(all[i]);
  return reel;
}

/// Gives the reel's pictures consecutive names, which ffmpeg wants; its pattern.
std::string laid_out(const Reel& reel, const fs::path& folder) {
  make_folder(folder);
  for (std::size_t i = 0; i < reel.frames.size(); ++i)
    link_file(reel.frames[i]->small, folder / fmt::format("{:06}.png", i));
  std::string pattern;
  for (const char c : fs::absolute(folder).string())
    pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return "file:" + pattern + "/%06d.png";
}

std::vector<std::string> ffmpeg(const Reel& reel, const std::string& pattern) {
  return {"ffmpeg",     "-hide_banner",
          "-loglevel",  "error",
          "-nostdin",   "-y",
          "-framerate", fmt::format("{:.6f}", reel.rate),
          "-threads",   "1",
          "-i",         pattern};
}

struct Format {
  const char* name;
  std::vector<std::string> arguments;
};

Format webp() {
  return {"webp", {"-c:v", "libwebp", "-quality", "78", "-compression_level", "3", "-pix_fmt", "yuv420p"}};
}

Format mp4(Size size) {
  const std::string even =
      fmt::format("pad={}:{}:color=black,", size.width + size.width % 2, size.height + size.height % 2);
  return {
      "mp4",
      {"-vf", even + "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bitexact",
       "-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries",
       "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv", "-movflags", "+faststart"}};
}

Format gif(Size size) {
  return {"gif",
          {"-filter_complex",
           fmt::format("scale={}:{}:flags=area,split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse="
                       "dither=bayer:bayer_scale=4:diff_mode=rectangle",
                       size.width, size.height)}};
}

enum class Made { yes, no, no_ffmpeg };

Made make(const Reel& reel, const std::string& pattern, const Format& format, const fs::path& file,
          const std::function<bool()>& stop, std::string& why) {
  const fs::path temporary = temporary_name(file);
  std::vector<std::string> command = ffmpeg(reel, pattern);
  command.insert(command.end(), format.arguments.begin(), format.arguments.end());
  for (const std::string& argument :
       {std::string("-threads"), std::string("1"), std::string("-fflags"), std::string("+bitexact"),
        std::string("-flags:v"), std::string("+bitexact"), std::string("-map_metadata"), std::string("-1")})
    command.push_back(argument);
  if (std::string_view(format.name) != "mp4") command.insert(command.end(), {"-loop", "0"});
  command.insert(command.end(), {"-f", format.name, "file:" + fs::absolute(temporary).string()});
  const ProcessResult result = run_process(command, stop);
  if (result.found && result.status == 0) {
    rename_into_place(temporary, file);
    return Made::yes;
  }
  remove_file(temporary);
  why = result.found ? one_line(result.error_output.substr(0, result.error_output.find('\n'))) : "";
  return result.found ? Made::no : Made::no_ffmpeg;
}

}  // namespace

std::vector<Animation> make_animations(PreviewMaterial& m, const Shown& shown, const fs::path& out,
                                       const fs::path& work, const std::function<bool()>& stop) {
  std::vector<Animation> made;
  std::string why;
  const auto attempt = [&](const Reel& reel, const std::string& pattern, const Format& format, Size size) {
    const std::string name = std::string("animation.") + format.name;
    const Made result = stop() ? Made::no : make(reel, pattern, format, out / name, stop, why);
    if (result == Made::yes)
      made.push_back({name, size, reel.frames.size(), reel.rate, fs::file_size(out / name)});
    return result;
  };
  if (shown.readable().size() > 1) {
    const Reel reel = reel_of(m, shown, shown.frames.size(), 30);
    const std::string pattern = laid_out(reel, work / "reel");
    Made result = attempt(reel, pattern, webp(), shown.size);
    if (result == Made::no) result = attempt(reel, pattern, mp4(shown.size), shown.size);
    if (result == Made::no_ffmpeg) {
      m.remarks.emplace_back("no animation: ffmpeg is not on the PATH");
    } else {
      if (result == Made::no && !stop()) m.remarks.push_back("no animation.webp or .mp4: ffmpeg: " + why);
      const Reel short_reel = reel_of(m, shown, most_gif_frames, 15);
      if (attempt(short_reel, laid_out(short_reel, work / "gif"), gif(size_within(shown.size, gif_box)),
                  size_within(shown.size, gif_box)) == Made::no &&
          !stop())
        m.remarks.push_back("no animation.gif: ffmpeg: " + why);
    }
  }
  for (const char* name : {"animation.webp", "animation.mp4", "animation.gif"}) {
    if (std::none_of(made.begin(), made.end(), [&](const Animation& a) { return a.file == name; }))
      remove_file(out / name);
  }
  return made;
}

}  // namespace lagomorph::apps
