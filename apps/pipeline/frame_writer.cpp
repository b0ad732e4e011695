#include "apps/pipeline/frame_writer.h"

#include <array>
#include <string>
#include <string_view>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/hash.h"
#include "apps/npy.h"
#include "apps/pipeline/crop.h"
#include "apps/pipeline/stopwatch.h"
#include "apps/run/channel_files.h"
#include "apps/run/state_file.h"
#include "render/channel_png.h"
#include "render/exr.h"
#include "render/png.h"
#include "sim/profile.h"

namespace lagomorph::apps {
namespace {

auto timed(sim::Stage stage, const auto& work) {
  const sim::Timed timer(stage);
  return work();
}

std::string encode_npy(const render::Channel& channel) {
  const std::array<std::size_t, 3> shape = {static_cast<std::size_t>(channel.height),
                                            static_cast<std::size_t>(channel.width),
                                            static_cast<std::size_t>(channel.components)};
  return npy_bytes(channel.values, std::span(shape).first(channel.components == 1 ? 2 : 3));
}

/// One of channel_files().
std::string encode_file(const std::string& file, const render::Image& image,
                        const render::RenderSettings& settings, double fps) {
  const render::PixelRegion drawn = settings.drawn();
  const render::ExrHeader header{
      .part = render::PartOfPicture{drawn.x0, drawn.y0, settings.width, settings.height}, .fps = fps};
  if (file == multilayer_file)
    return render::encode_multilayer_exr(image, settings.channels, settings.transparent, header);
  const std::string name(channel_of(file));
  const render::Channel* channel = image.find(name);
  if (channel == nullptr)
    throw Error(ExitStatus::machine, "the renderer '" + settings.backend + "' gave no channel " + name);
  const std::string_view extension = channel_extension(file);
  if (extension == png_extension) return render::encode_channel_png(*channel, settings.png_compression);
  return extension == exr_extension ? render::encode_exr(*channel, header) : encode_npy(*channel);
}

}  // namespace

FrameWriter::FrameWriter(const RunPaths& paths, const Identity& identity, const SceneDesc& scene,
                         const std::map<int, FrameRecord>& records, const Views& views, bool draws)
    : paths_(paths), identity_(identity), scene_(scene), records_(records), views_(views) {
  make_folder(paths.states());
  make_folder(paths.records());
  if (!draws) return;
  make_folder(paths.pictures());
  for (const std::string& file : channel_files(scene_.render)) make_folder(paths.channel(file));
}

std::optional<FrameWriter::Written> FrameWriter::write(const DrawnFrame& frame) const {
  const Stopwatch watch;
  const FrameJob& job = frame.of.job;
  const auto known = records_.find(job.frame);
  FrameRecord record = known == records_.end() ? FrameRecord{} : known->second;
  record.frame = job.frame;
  if (frame.of.made) record.state = write_state(frame.of.state, *frame.of.made);
  if (record.picture && record.picture->of_state != record.state->sha256) record.picture.reset();
  std::optional<Written> written;
  if (frame.image) {
    written.emplace();
    written->picture = timed(sim::Stage::overlays,
                             [&] { return views_.finish(*frame.image, frame.of.state, *record.state); });
    record.picture = write_picture(frame, written->picture);
    written->sha256 = record.picture->sha256;
    record.picture->of_state = record.state->sha256;
    record.picture->rendering_seconds = frame.seconds;
    record.picture->writing_seconds = watch.seconds();
  }
  if (frame.of.made || frame.image) write_record(paths_, record);
  return written;
}

StateRecord FrameWriter::write_state(const sim::State& state, StateRecord record) const {
  const sim::Timed timer(sim::Stage::write);
  const std::string bytes = encode_state(state);
  write_file(paths_.state(state.frame), bytes);
  record.sha256 = sha256(bytes);
  record.made_by = identity_.state_maker();
  return record;
}

PictureRecord FrameWriter::write_picture(const DrawnFrame& drawn, const render::Picture& picture) const {
  const render::Image& image = *drawn.image;
  const int frame = drawn.of.job.frame;
  const std::string png =
      timed(sim::Stage::encode, [&] { return render::encode_png(picture, scene_.render.png_compression); });
  PictureRecord record;
  record.sha256 = timed(sim::Stage::write, [&] {
    write_file(paths_.picture(frame), png);
    return sha256(png);
  });
  record.made_by = identity_.picture_hash();
  if (scene_.render.backend == "path") record.clamp = static_cast<double>(scene_.render.path.clamp);
  views_.tell(record);
  const bool whole = scene_.render.region.empty();
  const render::Image part = whole ? render::Image() : cropped(image, scene_.render.drawn());
  for (const std::string& file : channel_files(scene_.render)) {
    const std::string bytes = timed(sim::Stage::encode, [&] {
      return encode_file(file, whole ? image : part, scene_.render, scene_.time.fps);
    });
    record.channels[file] = timed(sim::Stage::write, [&] {
      write_file(paths_.channel(file, frame), bytes);
      return sha256(bytes);
    });
  }
  return record;
}

}  // namespace lagomorph::apps
