#include "apps/video/video.h"

#include <limits>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/video/process.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

/// A name that ffmpeg takes for a file's, whatever it begins with.
std::string file_name(const fs::path& path) {
  const std::string text = path.string();
  return text.starts_with("-") || text.find(':') != std::string::npos ? "file:" + text : text;
}

/// The pattern of the pictures for ffmpeg, to which a % in a folder's name is one of its own.
std::string picture_pattern(const VideoJob& job) {
  std::string text;
  for (const char c : file_name(job.pictures)) text += c == '%' ? std::string("%%") : std::string(1, c);
  return (fs::path(text) / (job.names.printf_format() + ".png")).string();
}

/// Pictures between which others are left out, one after the other as ffmpeg's protocol concat reads them.
std::string picture_list(const VideoJob& job) {
  std::string list;
  for (int frame = job.first; frame <= job.last; frame += job.every) {
    list += list.empty() ? "concat:file:" : "|file:";
    list += (job.pictures / job.names.file(frame, ".png")).string();
  }
  return list;
}

struct Codec {
  const char* name;
  const char* extension;
  std::vector<std::string> encoder;
  std::vector<std::string> container;
  bool alpha = false;            // keeps that of the pictures
  const char* filter = nullptr;  // of an animated picture, in sRGB; nullptr: a video, see filters()
  const char* tables = "";       // filter after all others, for an encoder that takes them from the pictures
  double most_rate = std::numeric_limits<double>::infinity();  // [1/s]
};
/// It knows no sRGB curve.
constexpr char prores_tables[] = ",setparams=colorspace=bt709:color_primaries=bt709:color_trc=bt709";
/// The explicit table: a new codec is one row.
const std::vector<Codec> codecs = {
    {"h264",
     ".mp4",
     {"-c:v", "libx264", "-preset", "medium", "-crf", "18", "-pix_fmt", "yuv420p"},
     {"-movflags", "+faststart", "-f", "mp4"}},
    // hvc1: what QuickTime and Safari play.
    {"h265",
     ".mp4",
     {"-c:v", "libx265", "-preset", "medium", "-crf", "21", "-pix_fmt", "yuv420p", "-tag:v", "hvc1",
      "-x265-params", "log-level=error:pools=none:frame-threads=1:info=0"},
     {"-movflags", "+faststart", "-f", "mp4"}},
    {"vp9",
     ".webm",
     {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-pix_fmt", "yuv420p", "-row-mt", "0"},
     {"-f", "webm"}},
    {"prores",
     ".mov",
     {"-c:v", "prores_ks", "-profile:v", "3", "-vendor", "apl0", "-pix_fmt", "yuv422p10le"},
     {"-f", "mov"},
     false,
     nullptr,
     prores_tables},
    {"webp",
     ".webp",
     {"-c:v", "libwebp_anim", "-quality", "90", "-compression_level", "4", "-pix_fmt", "bgra"},
     {"-loop", "0", "-f", "webp"},
     true,
     "null"},
    // One palette of all pictures; error diffusion hides its steps.
    {"gif",
     ".gif",
     {"-c:v", "gif"},
     {"-loop", "0", "-f", "gif"},
     false,
     "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=sierra2_4a",
     "",
     50.0},  // players show the delay of 1/100 s, which it counts in, as ten
    {"prores4444",
     ".mov",
     {"-c:v", "prores_ks", "-profile:v", "4", "-vendor", "apl0", "-pix_fmt", "yuva444p10le"},
     {"-f", "mov"},
     true,
     nullptr,
     prores_tables},
};

const Codec& find_codec(const std::string& name) {
  std::string names;
  for (const Codec& codec : codecs) {
    if (name == codec.name) return codec;
    names += (names.empty() ? "" : ", ") + std::string(codec.name);
  }
  throw Error(ExitStatus::wrong_input, "unknown video codec '" + name + "'; known are " + names);
}

int picture_count(const VideoJob& job) { return (job.last - job.first) / job.every + 1; }

std::string filters(const VideoJob& job) {
  std::string text;
  const Codec& codec = find_codec(job.codec);
  if (job.under && !codec.alpha) {
    const std::array<std::uint8_t, 3>& c = *job.under;
    text = fmt::format(
        "color=c=0x{:02x}{:02x}{:02x}:s={}x{}:r={:.17g},format=rgb24[under];[under][in]overlay=shortest=1:"
        "format=rgb,",
        c[0], c[1], c[2], job.width, job.height, job.fps / job.every);
  }
  // A palette is of these pictures, not of those after them.
  if (codec.filter != nullptr) text += fmt::format("trim=end_frame={},", picture_count(job));
  if (job.fps / job.every > codec.most_rate) text += fmt::format("fps={:g},", codec.most_rate);
  if (codec.filter != nullptr) return text + codec.filter;
  const int right = job.width % 2, bottom = job.height % 2;
  if (right + bottom > 0) {
    text += fmt::format("pad={}:{},fillborders=right={}:bottom={}:mode=smear,", job.width + right,
                        job.height + bottom, right, bottom);
  }
  text += "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bitexact";
  return text + codec.tables;
}

/// The last line that says something.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace

std::vector<std::string> video_codecs() {
  std::vector<std::string> names;
  names.reserve(codecs.size());
  for (const Codec& codec : codecs) names.emplace_back(codec.name);
  return names;
}

std::string video_extension(const std::string& codec) { return find_codec(codec).extension; }

std::string rate_remark(const std::string& codec, double rate) {
  const double most = find_codec(codec).most_rate;
  if (rate <= most) return "";
  return fmt::format("{} has {:g} pictures a second at most: some of {:g} are left out", codec, most, rate);
}

namespace {

std::vector<std::string> command_with(const VideoJob& job, const std::vector<std::string>& input) {
  const Codec& codec = find_codec(job.codec);
  std::vector<std::string> command = {"ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin", "-y"};
  const auto add = [&](const std::vector<std::string>& more) {
    command.insert(command.end(), more.begin(), more.end());
  };
  add(input);
  add({"-frames:v", std::to_string(picture_count(job)), "-vf", filters(job)});
  add(codec.encoder);
  // The tables of the sRGB pictures; without them players guess.
  if (codec.filter == nullptr) {
    add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range",
         "tv"});
  }
  // The same bytes on any machine: the encoders' decisions depend on their number of threads.
  add({"-threads", "4", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"});
  add(codec.container);
  command.push_back(file_name(job.output));
  return command;
}

std::string rate_text(const VideoJob& job) { return fmt::format("{:.17g}", job.fps / job.every); }

}  // namespace

std::vector<std::string> ffmpeg_command(const VideoJob& job) {
  if (job.every == 1) {
    return command_with(job, {"-framerate", rate_text(job), "-start_number", std::to_string(job.first), "-i",
                              picture_pattern(job)});
  }
  return command_with(job, {"-f", "png_pipe", "-framerate", rate_text(job), "-i", picture_list(job)});
}

std::vector<std::string> fed_ffmpeg_command(const VideoJob& job) {
  // Not -framerate, which is taken for the next common rate where that is near.
  return command_with(job,
                      {"-f", "rawvideo", "-pix_fmt", job.under ? "rgba" : "rgb24", "-video_size",
                       fmt::format("{}x{}", job.width, job.height), "-r", rate_text(job), "-i", "pipe:0"});
}

bool make_video(const VideoJob& job, const std::function<bool()>& stop) {
  // A list of pictures would be a long one.
  const std::string later =
      job.every == 1
          ? "; the pictures are there, make the video later with: " + shell_text(ffmpeg_command(job))
          : "; the pictures are there, the same command makes the video later";
  VideoJob temporary = job;
  temporary.output = temporary_name(job.output);
  const ProcessResult result = run_process(ffmpeg_command(temporary), stop);
  if (result.found && result.status == 0) {
    rename_into_place(temporary.output, job.output);
    return true;
  }
  remove_file(temporary.output);
  if (stop()) return false;
  if (!result.found) throw Error(ExitStatus::machine, "--video: ffmpeg is not on the PATH" + later);
  throw Error(ExitStatus::machine, fmt::format("--video: ffmpeg failed with status {}: {}{}", result.status,
                                               last_line(result.error_output), later));
}

}  // namespace lagomorph::apps
