#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/check/result.h"

/// What a frame may differ by, and who says so.
namespace lagomorph::apps {

enum class LimitName : std::size_t {
  flip_tile_max,
  flip_mean,
  flip_max,
  max_abs,
  mean_abs,
  rmse,
  pixels,
  psnr,
  ssim,
  bias_tile_max,
  bias_mean,
  flicker_tile_max,
  flicker_mean,
  mc_false_discovery,
  mc_global_z,
};
inline constexpr std::size_t limit_count = 15;

/// A row of the one table of limits.
struct LimitRow {
  const char* name;
  bool least;  // figures must be at least the limit
  double low;  // of the limit itself
  double high;
  const char* unit;
  const char* meaning;
};
const LimitRow& limit_row(LimitName);
std::span<const LimitRow, limit_count> limit_rows();
std::vector<std::string> limit_names();

struct LimitValue {
  std::optional<double> value;  // none: the figure is not held to anything
  std::string from;
  /// Instead, where the light itself was tested: that tells noise from a fault, the picture's tiles need only
  /// guard what comes after the light. None: `value` always.
  std::optional<double> light_tested = {};
};

/// All limits of a frame.
class Limits {
public:
  LimitValue& operator[](LimitName name) { return values_[static_cast<std::size_t>(name)]; }
  const LimitValue& operator[](LimitName name) const { return values_[static_cast<std::size_t>(name)]; }
  /// Those that are set.
  std::vector<LimitTold> told() const;

private:
  std::array<LimitValue, limit_count> values_;
};

/// "exact", "lsb", "render", "mc".
std::vector<std::string> preset_names();
inline constexpr char default_preset[] = "render";
/// The limits of a preset; `who` says where it was chosen ("the default", "golden.toml:1:10").
Limits preset_limits(const std::string& preset, const std::string& who);

/// The rules that a compared frame's figures break. Alpha is held to the limits of what it has in common with
/// colours: flip_tile_max, flip_mean and max_abs.
std::vector<CheckFailure> broken_limits(const FrameResult&, const Limits&);
/// Likewise of how its differences changed since the frame before.
std::vector<CheckFailure> broken_flicker_limits(const FrameResult&, const Limits&);

}  // namespace lagomorph::apps
