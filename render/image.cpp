#include "render/image.h"

namespace lagomorph::render {

std::vector<float>& Image::add(std::string_view name, int components, int cell) {
  for (Channel& c : channels_) {
    if (c.name == name) return c.values;
  }
  const int width = (width_ + cell - 1) / cell, height = (height_ + cell - 1) / cell;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(components);
  channels_.push_back({std::string(name), components, std::vector<float>(count, 0.0F), width, height});
  return channels_.back().values;
}

const Channel* Image::find(std::string_view name) const {
  for (const Channel& c : channels_) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

}  // namespace lagomorph::render
