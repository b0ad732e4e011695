#include "apps/check/compare_frame.h"

#include <utility>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "apps/check/light_statistics.h"
#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/hash.h"
#include "render/image_compare/gate.h"
#include "render/png_read.h"

namespace lagomorph::apps {
namespace {

/// What `read` gives; a failure "unreadable" when it throws what a bad file does.
template <class Read>
auto try_to(const Read& read, FrameResult& result) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const Error& error) {
    if (error.status != ExitStatus::wrong_input) throw;
    result.failures.push_back({"unreadable", error.what(), "", ""});
  } catch (const render::PictureError& error) {
    result.failures.push_back({"unreadable", error.what(), "", ""});
  }
  return std::nullopt;
}

void add_kinds(FrameResult& result, const render::PngHeader& golden, const render::PngHeader& fresh) {
  for (const render::GateFailure& failure :
       render::gate_kinds(render::kind_of(golden), render::kind_of(fresh))) {
    result.failures.push_back({failure.rule, failure.found + " (golden, new)", "", ""});
  }
}

void take_equal(ComparedFrame& compared, DecidedBy by, int width, int height, bool alpha) {
  compared.result.decided_by = by;
  compared.result.figures = render::figures_of_equals(width, height, alpha);
  compared.bias = {width, height, {}};
  compared.result.bias = render::bias_figures(compared.bias);
}

/// The test of the light itself, where a limit asks for it and both sides left statistics.
void test_light(FrameResult& result, const FramePair& pair, const Limits& limits,
                const std::vector<std::uint8_t>& mask, const render::Pixels& golden) {
  const LimitValue& discovery = limits[LimitName::mc_false_discovery];
  if (!discovery.value && !limits[LimitName::mc_global_z].value) return;
  const auto statistics = [&](const std::filesystem::path& picture, const char* whose) {
    auto there = read_light_statistics(picture, golden.width, golden.height);
    if (!there) {
      result.no_light += fmt::format("{}{} has none", result.no_light.empty() ? "" : ", ", whose);
    } else if (!there->usable()) {
      result.no_light += fmt::format("{}{} has a sample a pixel, and so no variance",
                                     result.no_light.empty() ? "" : ", ", whose);
      there.reset();
    }
    return there;
  };
  try {
    const auto of_golden = statistics(pair.golden, "the golden"),
               of_fresh = statistics(pair.fresh, "the run");
    if (of_golden && of_fresh)
      result.light = render::compare_light(*of_golden, *of_fresh, mask, discovery.value.value_or(0));
  } catch (const Error& error) {
    if (error.status != ExitStatus::wrong_input) throw;
    result.failures.push_back({"statistics", error.what(), "", ""});
  }
}

/// Of two pictures of one kind.
void compare_pixels(ComparedFrame& compared, render::Pixels golden, render::Pixels fresh,
                    const FramePair& pair, const Limits& limits, const std::vector<std::uint8_t>& mask,
                    double pixels_per_degree) {
  FrameResult& result = compared.result;
  if (golden.samples == fresh.samples) {
    take_equal(compared, DecidedBy::pixels, golden.width, golden.height, golden.alpha);
    return;
  }
  result.decided_by = DecidedBy::metrics;
  render::Comparison comparison = render::compare_pictures(golden, fresh, pixels_per_degree);
  compared.bias = render::tile_bias(golden, fresh);
  result.figures = comparison.figures;
  result.bias = render::bias_figures(compared.bias);
  test_light(result, pair, limits, mask, golden);
  for (CheckFailure& failure : broken_limits(result, limits)) result.failures.push_back(std::move(failure));
  if (comparison.flip.values.empty()) {  // alpha alone differs
    comparison.flip = {golden.width, golden.height, std::vector<float>(golden.pixel_count())};
  }
  compared.flip = std::move(comparison.flip);
  compared.golden = std::move(golden);
  compared.fresh = std::move(fresh);
}

void judge(ComparedFrame& compared, const FramePair& pair, const Limits& limits, const Masks& masks,
           double pixels_per_degree) {
  FrameResult& result = compared.result;
  const auto golden_bytes = try_to([&] { return read_file(pair.golden); }, result);
  const auto fresh_bytes = try_to([&] { return read_file(pair.fresh); }, result);
  if (fresh_bytes) result.fresh_sha256 = sha256(*fresh_bytes);
  if (!golden_bytes || !fresh_bytes) return;
  const bool equal = *golden_bytes == *fresh_bytes;
  const auto header = [](const std::string& bytes, const std::filesystem::path& file) {
    return [&] { return render::read_png_header(bytes, file.string()); };
  };
  const auto golden_header = try_to(header(*golden_bytes, pair.golden), result);
  if (!golden_header && equal) return;  // said once
  const auto fresh_header = equal ? golden_header : try_to(header(*fresh_bytes, pair.fresh), result);
  if (!golden_header || !fresh_header) return;
  add_kinds(result, *golden_header, *fresh_header);
  if (!result.passed()) return;
  const auto mask =
      masks.of(pair.frame, pair.golden, golden_header->width, golden_header->height, result.failures);
  result.masked = masked_share(mask);
  if (!result.passed()) return;
  if (equal) {
    take_equal(compared, DecidedBy::bytes, golden_header->width, golden_header->height, golden_header->alpha);
    return;
  }
  const auto picture = [](const std::string& bytes, const std::filesystem::path& file) {
    return [&] { return render::read_png(bytes, file.string()); };
  };
  auto golden = try_to(picture(*golden_bytes, pair.golden), result);
  auto fresh = try_to(picture(*fresh_bytes, pair.fresh), result);
  if (!golden || !fresh) return;
  cover(mask, *golden, *fresh);
  compare_pixels(compared, std::move(*golden), std::move(*fresh), pair, limits, mask, pixels_per_degree);
}

}  // namespace

ComparedFrame compare_frame(const FramePair& pair, const Limits& limits, const Masks& masks,
                            double pixels_per_degree) {
  ComparedFrame compared;
  compared.result.frame = pair.frame;
  compared.result.golden = pair.golden;
  compared.result.fresh = pair.fresh;
  compared.result.variant = pair.variant;
  // Isolated: a thread that waits within a frame begins no other, whose pictures would take memory too.
  tbb::this_task_arena::isolate([&] { judge(compared, pair, limits, masks, pixels_per_degree); });
  if (compared.result.passed()) {
    compared.golden.reset();
    compared.fresh.reset();
    compared.flip.reset();
  }
  return compared;
}

}  // namespace lagomorph::apps
