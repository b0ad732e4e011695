#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Channels that a renderer draws beside the colour, when asked to.
namespace lagomorph::render {

inline constexpr char color_channel[] = "color";
/// What is seen through the pixel's centre, at the frame's time and through a pinhole; the ground is a
/// surface over its whole disc. Where nothing is: 0, but for the depth, which is +inf there [m along the view
/// axis].
inline constexpr char depth_channel[] = "depth";
inline constexpr char normal_channel[] = "normal";      // unit shading normal, world, on the camera's side
inline constexpr char albedo_channel[] = "albedo";      // see albedo.h
inline constexpr char position_channel[] = "position";  // world [m]
/// How far the point has gone in the picture since the frame before: x right, y up [pixels].
inline constexpr char motion_channel[] = "motion";
/// The number of the body, -1 of the ground and where nothing is, and that of the triangle in the mesh that
/// is drawn of it, likewise.
inline constexpr char body_id_channel[] = "body_id";
inline constexpr char triangle_id_channel[] = "triangle_id";

/// How much of the pixel, as the colour sees it, bodies, visible lights and the ground cover; the ground
/// counts as it is opaque where it fades. In [0, 1]; the colour of a transparent picture is times it already.
inline constexpr char alpha_channel[] = "alpha";

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

/// How a channel's values stand in a PNG, where they fit: see channel_png.h.
enum class PngForm { none, unit_vector, color, part, length, id, count };

/// A row of the one table of channels.
struct ChannelKind {
  const char* name;
  const char* parts = "X";  // a letter for each component, as OpenEXR files call them
  int components = 1;       // values a cell
  int cell = 1;             // side of the square that has its own values [pixels]
  bool path_only = false;
  bool is_layer = true;  // OpenEXR files call it <name>.<letter>; false: by the letter alone
  PngForm png = PngForm::none;
};
std::span<const ChannelKind> channel_kinds();
std::vector<std::string> channel_names();
/// Throws SettingsError for an unknown name (listing the valid ones).
const ChannelKind& channel_kind(std::string_view name);

}  // namespace lagomorph::render
