#include "apps/run/disk_space.h"

#include <array>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/run/state_file.h"
#include "render/channels.h"

namespace lagomorph::apps {

namespace fs = std::filesystem;

ExpectedSize expected_size(const std::vector<FrameJob>& jobs, int vertices, int levels,
                           const render::RenderSettings& render) {
  constexpr std::size_t record = 4096;
  const std::size_t pixels =
      static_cast<std::size_t>(render.drawn().width()) * static_cast<std::size_t>(render.drawn().height());
  std::size_t channels = 0;  // of known size
  std::size_t compressed = 0;
  if (render.channel_format == "exr_multilayer") compressed += 4 * pixels * sizeof(float);
  for (const std::string& name : render.channels) {
    const render::ChannelKind& kind = render::channel_kind(name);
    const auto cells = [&](int side) { return static_cast<std::size_t>((side + kind.cell - 1) / kind.cell); };
    const bool is_npy = render.channel_format == "npy" || name == render::statistics_channel;
    (is_npy ? channels : compressed) += cells(render.drawn().width()) * cells(render.drawn().height()) *
                                        static_cast<std::size_t>(kind.components) *
                                        (render.channel_format == "png" && !is_npy ? 2 : sizeof(float));
  }
  const std::size_t usual_share =
      render.backend == "path" ? 2 : 3;  // of 3 bytes a pixel; noise compresses less
  ExpectedSize size;
  for (const FrameJob& job : jobs) {
    const std::size_t known =
        record + (job.simulate ? state_file_size(vertices, levels) : 0) + (job.draw ? channels : 0);
    size.least += known + (job.draw ? pixels / 20 : 0);
    size.estimate += known + (job.draw ? 3 * pixels / usual_share + compressed / 2 : 0);
  }
  return size;
}

void require_space(const fs::path& folder, const ExpectedSize& size) {
  std::error_code error;
  fs::path there = fs::absolute(folder);
  while (!fs::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  const fs::space_info space = fs::space(there, error);
  // Some file systems tell of no sizes.
  if (error || space.capacity == 0 || space.available >= size.least) return;
  throw Error(
      ExitStatus::machine,
      fmt::format("{}: {} are free on its disk; the run takes at least {} (about {})", folder.string(),
                  size_text(space.available), size_text(size.least), size_text(size.estimate)));
}

std::string size_text(std::size_t bytes) {
  constexpr std::array units = {"bytes", "kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < units.size(); ++unit) value /= 1000.0;
  if (unit == 0) return fmt::format("{} bytes", bytes);
  return fmt::format("{:.{}f} {}", value, value < 9.95 ? 1 : 0, units[unit]);
}

}  // namespace lagomorph::apps
