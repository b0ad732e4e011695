#include "apps/check/report_pictures.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/page/webp.h"
#include "apps/pipeline/stop.h"
#include "apps/preview/shown.h"
#include "apps/preview/small_picture.h"
#include "apps/run/paths.h"
#include "render/png.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 5'200'000;  // of all pictures; a third more as base64
constexpr std::size_t most_worst = 6;          // frames at full size
constexpr std::size_t most_small = 40;         // further frames that differ
constexpr std::size_t key_frames = 5;
constexpr Size small_box = {320, 320};
constexpr int kept_compression = 6;  // zlib

/// A picture as a PNG that any browser shows.
struct Kept {
  std::string bytes;
  Size size;
};

std::optional<Kept> whole_picture(const fs::path& file) {
  if (file.empty()) return std::nullopt;
  try {
    Kept kept{read_file(file), {}};
    const render::Pixels pixels = render::read_png(kept.bytes, file.string());
    kept.size = {pixels.width, pixels.height};
    return kept;
  } catch (const Error&) {
    return std::nullopt;
  } catch (const render::PictureError&) {
    return std::nullopt;
  }
}

std::optional<Kept> smaller_picture(const std::optional<Kept>& whole, Size size) {
  if (!whole) return std::nullopt;
  const render::Picture picture = opaque_picture(render::read_png(whole->bytes, ""));
  return Kept{render::encode_png(resized(picture, size), kept_compression), size};
}

class Gathering {
public:
  Gathering(const CheckResult& result, const KeepPicture& keep)
      : result_(result), keep_(keep), work_(result.out) {}

  std::vector<ReportPictures> all() {
    const std::vector<const FrameResult*> worst = worst_first(result_);
    std::vector<const FrameResult*> others, equal;
    for (const FrameResult& f : result_.frames) {
      if (!f.passed()) continue;
      (f.decided_by == DecidedBy::metrics ? others : equal).push_back(&f);
    }
    std::stable_sort(others.begin(), others.end(), [](const FrameResult* a, const FrameResult* b) {
      return a->figures->flip_tile.mean > b->figures->flip_tile.mean;
    });
    std::vector<const FrameResult*> rest;
    for (std::size_t i = 0; i < worst.size(); ++i) {
      if (i >= most_worst || !add_large(*worst[i], i == 0)) rest.push_back(worst[i]);
    }
    rest.insert(rest.end(), others.begin(), others.end());
    rest.resize(std::min(rest.size(), most_small));
    for (const std::size_t i : evenly(equal.size(), key_frames)) rest.push_back(equal[i]);
    for (const FrameResult* frame : rest) add_small(*frame);
    std::sort(all_.begin(), all_.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
    return std::move(all_);
  }

private:
  std::string keep(int frame, const char* what, const std::optional<Kept>& picture) {
    if (!picture) return "";
    used_ += picture->bytes.size();
    return keep_(frame_file(frame, fmt::format("_{}.png", what)), "image/png", picture->bytes);
  }

  /// At full size; only the very worst is made smaller to fit.
  bool add_large(const FrameResult& frame, bool must) {
    std::optional<Kept> golden = whole_picture(frame.golden), fresh = whole_picture(frame.fresh);
    std::optional<Kept> heat = whole_picture(frame.heat.empty() ? fs::path{} : result_.out / frame.heat);
    if (!golden && !fresh) return true;
    const Size size = fresh ? fresh->size : golden->size;
    const auto bytes = [&] {
      std::size_t sum = 0;
      for (const auto* p : {&golden, &fresh, &heat}) sum += *p ? (*p)->bytes.size() : 0;
      return sum;
    };
    int smaller = 1;
    while (used_ + bytes() > most_bytes * 3 / 4) {
      if (!must || size.width / (2 * smaller) < 16) return false;
      smaller *= 2;
      for (auto* p : {&golden, &fresh, &heat}) {
        if (!*p) continue;
        const Size half{std::max(1, (*p)->size.width / 2), std::max(1, (*p)->size.height / 2)};
        *p = smaller_picture(*p, half);
      }
    }
    ReportPictures pictures{frame.frame, "", "", "", size.width, size.height, smaller};
    pictures.golden = keep(frame.frame, "golden", golden);
    pictures.fresh = keep(frame.frame, "new", fresh);
    pictures.heat = keep(frame.frame, "heat", heat);
    all_.push_back(std::move(pictures));
    return true;
  }

  void add_small(const FrameResult& frame) {
    if (used_ > most_bytes) return;
    const std::optional<Kept> fresh = whole_picture(frame.fresh);
    // Of equal ones one is enough.
    const bool differs = frame.decided_by == DecidedBy::metrics || frame.decided_by == DecidedBy::nothing;
    const std::optional<Kept> golden = differs || !fresh ? whole_picture(frame.golden) : std::nullopt;
    const std::optional<Kept> heat =
        whole_picture(frame.heat.empty() ? fs::path{} : result_.out / frame.heat);
    if (!golden && !fresh) return;
    const Size size = fresh ? fresh->size : golden->size;
    const Size small = size_within(size, small_box);
    ReportPictures pictures{frame.frame,
                            "",
                            "",
                            "",
                            size.width,
                            size.height,
                            std::max(1, (size.width + small.width - 1) / small.width)};
    pictures.golden = keep_small(frame.frame, "golden", golden);
    pictures.fresh = keep_small(frame.frame, "new", fresh);
    pictures.heat = keep_small(frame.frame, "heat", heat);
    all_.push_back(std::move(pictures));
  }

  /// WebP where ffmpeg makes it, otherwise PNG.
  std::string keep_small(int frame, const char* what, const std::optional<Kept>& whole) {
    if (!whole) return "";
    const std::optional<Kept> png = smaller_picture(whole, size_within(whole->size, small_box));
    if (has_webp_ && png->bytes.size() > 20'000) {
      const fs::path file = work_.path() / "small.png";
      write_file(file, png->bytes);
      const std::vector<std::string> webp = webps({file}, work_.path() / "webp", [] { return stop_asked(); });
      has_webp_ = !webp.empty();
      if (has_webp_) {
        used_ += webp.front().size();
        return keep_(frame_file(frame, fmt::format("_{}.webp", what)), "image/webp", webp.front());
      }
    }
    return keep(frame, what, png);
  }

  const CheckResult& result_;
  const KeepPicture& keep_;
  WorkFolder work_;
  bool has_webp_ = true;
  std::size_t used_ = 0;
  std::vector<ReportPictures> all_;
};

}  // namespace

std::vector<ReportPictures> report_pictures(const CheckResult& result, const KeepPicture& keep) {
  return Gathering(result, keep).all();
}

}  // namespace lagomorph::apps
