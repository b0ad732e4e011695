#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Channels that a renderer draws beside the colour, when asked to.
namespace lagomorph::render {

inline constexpr char color_channel[] = "color";
inline constexpr char depth_channel[] = "depth";
/// The number of the body that is seen through the pixel's centre, -1 where none is.
inline constexpr char body_id_channel[] = "body_id";

/// Paths that the pixel took.
inline constexpr char sample_count_channel[] = "sample_count";

/// Variance of the pixel's colour, which is the mean of its paths, for R, G and B; see path/tile_means.h. NaN
/// where there was one path.
inline constexpr char variance_channel[] = "variance";
/// What denoisers are guided by: means over the pixel's paths of what the camera sees first, through lens and
/// shutter. Albedo (see albedo.h) and unit shading normal (world, on the camera's side) are 0 where nothing
/// is, and weigh as the ground is opaque where it fades. The depth is that of the surfaces alone [m along the
/// view axis], +inf where none is.
inline constexpr char denoising_albedo_channel[] = "denoising_albedo";
inline constexpr char denoising_normal_channel[] = "denoising_normal";
inline constexpr char denoising_depth_channel[] = "denoising_depth";

/// Statistics of path-traced light over cells of 8x8 pixels from the picture's corner: mean R, G, B of the
/// radiance (linear, before exposure and tone curve), the variance of that mean for R, G and B, the number of
/// batches that the variance was found between (NaN with 1), and of samples a pixel.
inline constexpr char statistics_channel[] = "tile_statistics";
inline constexpr int statistics_cell = 8;  // [pixels]
inline constexpr int statistics_components = 8;

/// A row of the one table of channels.
struct ChannelKind {
  const char* name;
  int components = 1;  // values a cell
  int cell = 1;        // side of the square that has its own values [pixels]
  bool path_only = false;
};
std::span<const ChannelKind> channel_kinds();
std::vector<std::string> channel_names();
/// Throws SettingsError for an unknown name (listing the valid ones).
const ChannelKind& channel_kind(std::string_view name);

}  // namespace lagomorph::render
