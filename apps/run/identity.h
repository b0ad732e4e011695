#pragma once

#include <string>
#include <vector>

#include "apps/scene/scene.h"
#include "apps/scene/scene_desc.h"

namespace lagomorph::apps {

/// Everything that the bytes of a run follow from, as keys and values. Who has the same may keep a file.
class Identity {
public:
  Identity() = default;
  Identity(std::vector<ResolvedKey> simulation, std::vector<ResolvedKey> picture,
           std::vector<ResolvedKey> simulation_build, std::vector<ResolvedKey> picture_build);

  const std::vector<ResolvedKey>& simulation() const { return simulation_; }  // scene: what states depend on
  const std::vector<ResolvedKey>& picture() const { return picture_; }        // scene: only pictures do
  const std::vector<ResolvedKey>& simulation_build() const { return simulation_build_; }  // what steps
  const std::vector<ResolvedKey>& picture_build() const {
    return picture_build_;
  }  // what draws; empty: none did

  const std::string& simulation_hash() const { return simulation_hash_; }  // of the scene's simulation
  const std::string& picture_hash() const { return picture_hash_; }  // and of its pictures, and what draws
  const std::string& state_maker() const {
    return state_maker_;
  }  // of the scene's simulation, and what steps

private:
  std::vector<ResolvedKey> simulation_, picture_, simulation_build_, picture_build_;
  std::string simulation_hash_, picture_hash_, state_maker_;
};

/// The scene's keys and this program's build. `renderer` is Renderer::description(); empty when none draws.
Identity make_identity(const SceneDesc&, const std::string& renderer);

/// One text a key that differs, "body.0.density 1000 -> 500", in order.
std::vector<std::string> key_differences(const std::vector<ResolvedKey>& there,
                                         const std::vector<ResolvedKey>& wanted);
/// The same of the scene's keys, then the build's. Pictures' keys only when
/// `with_pictures`.
std::vector<std::string> differences(const Identity& there, const Identity& wanted, bool with_pictures);

}  // namespace lagomorph::apps
