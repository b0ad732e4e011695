#include "apps/run/identity.h"

#include <algorithm>
#include <utility>

#include "apps/hash.h"
#include "apps/run/environment.h"

namespace lagomorph::apps {
namespace {

using Keys = std::vector<ResolvedKey>;

std::string lines(const Keys& keys) {
  std::string text;
  for (const ResolvedKey& k : keys) text += k.key + " = " + k.value + "\n";
  return text;
}

const std::string* find(const Keys& keys, const std::string& key) {
  const auto at = std::find_if(keys.begin(), keys.end(), [&](const ResolvedKey& k) { return k.key == key; });
  return at == keys.end() ? nullptr : &at->value;
}

/// A value that fits into a message: lists of vertices and hashes are long.
std::string shortened(const std::string* value) {
  constexpr std::size_t most = 48;
  if (value == nullptr) return "default";
  return value->size() <= most ? *value : value->substr(0, most - 3) + "...";
}

}  // namespace

Identity::Identity(Keys simulation, Keys picture, Keys simulation_build, Keys picture_build)
    : simulation_(std::move(simulation)),
      picture_(std::move(picture)),
      simulation_build_(std::move(simulation_build)),
      picture_build_(std::move(picture_build)),
      simulation_hash_(sha256(lines(simulation_))),
      picture_hash_(sha256(lines(simulation_) + lines(picture_) + lines(picture_build_))),
      state_maker_(sha256(lines(simulation_) + lines(simulation_build_))) {}

Identity make_identity(const SceneDesc& scene, const std::string& renderer) {
  return {simulation_keys(scene), picture_keys(scene), simulation_build_keys(),
          renderer.empty() ? Keys{} : picture_build_keys(renderer)};
}

std::vector<std::string> key_differences(const Keys& there, const Keys& wanted) {
  std::vector<std::string> out;
  const auto add = [&](const std::string& key, const std::string* a, const std::string* b) {
    out.push_back(key + " " + shortened(a) + " -> " + shortened(b));
  };
  for (const ResolvedKey& k : wanted) {
    const std::string* old = find(there, k.key);
    if (old == nullptr || *old != k.value) add(k.key, old, &k.value);
  }
  for (const ResolvedKey& k : there) {
    if (find(wanted, k.key) == nullptr) add(k.key, &k.value, nullptr);
  }
  return out;
}

std::vector<std::string> differences(const Identity& there, const Identity& wanted, bool with_pictures) {
  std::vector<std::string> out;
  const auto add = [&](const Keys& a, const Keys& b) {
    for (std::string& line : key_differences(a, b)) out.push_back(std::move(line));
  };
  add(there.simulation(), wanted.simulation());
  if (with_pictures) add(there.picture(), wanted.picture());
  add(there.simulation_build(), wanted.simulation_build());
  if (with_pictures) add(there.picture_build(), wanted.picture_build());
  return out;
}

}  // namespace lagomorph::apps
