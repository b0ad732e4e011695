#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "apps/scene/scene_desc.h"

namespace lagomorph::apps {

/// Where each key and table that the scene gives stands, as a message begins ("a.toml:3:7: "), by its path
/// ("body.0.density").
class Places {
public:
  void add(const std::string& path, std::string place) { places_[path] = std::move(place); }
  bool has(const std::string& path) const { return places_.count(path) != 0; }
  /// Whether --set gives the key, or a part of it.
  bool overridden(const std::string& path) const { return has(path) && of(path).starts_with("--set "); }
  /// Of the key; of what holds it when it is not given itself.
  std::string of(std::string path) const;

private:
  std::map<std::string, std::string> places_;  // "" is the file
};

/// Every key of the text and the overrides with its type, range and choices checked; what is not given has
/// its default. Throws Error(wrong_input).
SceneDesc read_scene(std::string_view text, const std::string& origin, std::span<const std::string> overrides,
                     Places&);

/// Fills in the defaults that depend on other keys and checks what keys must hold together. `stem` is the
/// default of the scene's name. Throws Error(wrong_input).
void resolve_scene(SceneDesc&, const Places&, const std::string& stem);

/// Checks what keys of camera, panels and region must hold together. Throws Error(wrong_input).
void check_views(const SceneDesc&, const Places&);

/// Checks that the files that the scene names are there and of a known format. Throws Error(wrong_input).
void check_scene_files(const SceneDesc&, const Places&);

}  // namespace lagomorph::apps
