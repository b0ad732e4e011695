#include "render/image.h"

namespace lagomorph::render {

std::vector<float>& Image::add(std::string_view name, int components) {
  for (Channel& c : channels_) {
    if (c.name == name) return c.values;
  }
  const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                            static_cast<std::size_t>(components);
  channels_.push_back({std::string(name), components, std::vector<float>(count, 0.0F)});
  return channels_.back().values;
}

const Channel* Image::find(std::string_view name) const {
  for (const Channel& c : channels_) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

}  // namespace lagomorph::render
