#include "apps/video/video.h"

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
std::string picture_pattern(const fs::path& folder) {
  std::string text;
  for (const char c : file_name(folder)) text += c == '%' ? std::string("%%") : std::string(1, c);
  return (fs::path(text) / "frame_%04d.png").string();
}

struct Codec {
  const char* name;
  const char* extension;
  std::vector<std::string> encoder;
  std::vector<std::string> container;
  bool alpha = false;  // keeps that of the pictures
};
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
     {"-f", "mov"}},
    {"prores4444",
     ".mov",
     {"-c:v", "prores_ks", "-profile:v", "4", "-vendor", "apl0", "-pix_fmt", "yuva444p10le"},
     {"-f", "mov"},
     true},
};

const Codec& find_codec(const std::string& name) {
  std::string names;
  for (const Codec& codec : codecs) {
    if (name == codec.name) return codec;
    names += (names.empty() ? "" : ", ") + std::string(codec.name);
  }
  throw Error(ExitStatus::wrong_input, "unknown video codec '" + name + "'; known are " + names);
}

std::string filters(const VideoJob& job) {
  std::string text;
  if (job.under && !find_codec(job.codec).alpha) {
    const std::array<std::uint8_t, 3>& c = *job.under;
    text = fmt::format(
        "color=c=0x{:02x}{:02x}{:02x}:s={}x{}:r={:.17g},format=rgb24[under];[under][in]overlay=shortest=1:"
        "format=rgb,",
        c[0], c[1], c[2], job.width, job.height, job.fps);
  }
  const int right = job.width % 2, bottom = job.height % 2;
  if (right + bottom > 0) {
    text += fmt::format("pad={}:{},fillborders=right={}:bottom={}:mode=smear,", job.width + right,
                        job.height + bottom, right, bottom);
  }
  return text + "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bitexact";
}

/// The last line that says something.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace

std::vector<std::string> video_codecs() {
  std::vector<std::string> names;
  for (const Codec& codec : codecs) names.emplace_back(codec.name);
  return names;
}

std::string video_extension(const std::string& codec) { return find_codec(codec).extension; }

std::vector<std::string> ffmpeg_command(const VideoJob& job) {
  std::vector<std::string> command = {"ffmpeg",
                                      "-hide_banner",
                                      "-loglevel",
                                      "error",
                                      "-nostdin",
                                      "-y",
                                      "-framerate",
                                      fmt::format("{:.17g}", job.fps),
                                      "-start_number",
                                      std::to_string(job.first),
                                      "-i",
                                      picture_pattern(job.pictures),
                                      "-frames:v",
                                      std::to_string(job.last - job.first + 1),
                                      "-vf",
                                      filters(job)};
  const auto add = [&](const std::vector<std::string>& more) {
    command.insert(command.end(), more.begin(), more.end());
  };
  const Codec& codec = find_codec(job.codec);
  add(codec.encoder);
  // The tables of the sRGB pictures; without them players guess.
  add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range",
       "tv"});
  // The same bytes on any machine: the encoders' decisions depend on their number of threads.
  add({"-threads", "4", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"});
  add(codec.container);
  command.push_back(file_name(job.output));
  return command;
}

bool make_video(const VideoJob& job, const std::function<bool()>& stop) {
  const std::string later =
      "; the pictures are there, make the video later with: " + shell_text(ffmpeg_command(job));
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
