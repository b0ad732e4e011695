#include "render/channels.h"

#include "render/error.h"

namespace lagomorph::render {
namespace {

constexpr ChannelKind kinds[] = {
    {.name = color_channel, .parts = "RGB", .components = 3, .is_layer = false},
    {.name = depth_channel, .parts = "Z", .is_layer = false, .png = PngForm::length},
    {.name = normal_channel, .parts = "XYZ", .components = 3, .png = PngForm::unit_vector},
    {.name = albedo_channel, .parts = "RGB", .components = 3, .png = PngForm::color},
    {.name = position_channel, .parts = "XYZ", .components = 3},
    {.name = motion_channel, .parts = "XY", .components = 2},
    {.name = alpha_channel, .parts = "A", .png = PngForm::part},
    {.name = body_id_channel, .png = PngForm::id},
    {.name = triangle_id_channel, .png = PngForm::id},
    {.name = sample_count_channel, .path_only = true, .png = PngForm::count},
    {.name = variance_channel, .parts = "RGB", .components = 3, .path_only = true},
    {.name = denoising_albedo_channel,
     .parts = "RGB",
     .components = 3,
     .path_only = true,
     .png = PngForm::color},
    {.name = denoising_normal_channel,
     .parts = "XYZ",
     .components = 3,
     .path_only = true,
     .png = PngForm::unit_vector},
    {.name = denoising_depth_channel, .parts = "Z", .path_only = true, .png = PngForm::length},
    {.name = statistics_channel,
     .parts = "01234567",
     .components = statistics_components,
     .cell = statistics_cell,
     .path_only = true},
};

}  // namespace

std::span<const ChannelKind> channel_kinds() { return kinds; }

std::vector<std::string> channel_names() {
  std::vector<std::string> names;
  for (const ChannelKind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

const ChannelKind& channel_kind(std::string_view name) {
  std::string known;
  for (const ChannelKind& kind : kinds) {
    if (name == kind.name) return kind;
    known += std::string(known.empty() ? "" : ", ") + kind.name;
  }
  throw SettingsError("render.channels: unknown channel '" + std::string(name) + "'; known are " + known);
}

}  // namespace lagomorph::render
