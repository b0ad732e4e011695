#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/scene_desc.h"

namespace lagomorph::apps {

/// Reads a scene file, applies `--set key.path=VALUE` in order, checks every key and range. Throws
/// Error(wrong_input) with `file:line:column: ...`, or `--set key=value: ...` for an override.
SceneDesc load_scene(const std::filesystem::path& file, std::span<const std::string> overrides);

/// The same of a text, as if it stood in `file`; whether the files that it names are there is not checked.
SceneDesc parse_scene(std::string_view text, const std::filesystem::path& file,
                      std::span<const std::string> overrides);

/// The scene as TOML with every key written out; parsing it gives the same description. Floats round-trip.
std::string scene_to_toml(const SceneDesc&);

/// A value that is not the key's default, ("body.0.density", "900"), or the size of a table, ("light", "2 of
/// them"). In the fixed order of the key table; for hashes and differences.
struct ResolvedKey {
  std::string key;
  std::string value;  // as in TOML; of a file the hash of its contents
};
/// Keys that the states depend on: bodies (physics, the mesh by the hash of its contents), time but `frames`,
/// solver; not the name.
std::vector<ResolvedKey> simulation_keys(const SceneDesc&);
/// Keys that only the pictures depend on: surfaces, looks, camera, render, ground, light, sky, background.
std::vector<ResolvedKey> picture_keys(const SceneDesc&);

/// Every input file that the scene names (absolute), with the key that names it, in order and without
/// repetition.
struct InputFile {
  std::string key;
  std::filesystem::path path;
};
std::vector<InputFile> input_files(const SceneDesc&);

/// The files behind a mesh's name: TetGen's .node and .ele come in pairs.
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& mesh);

/// One row a key: name, default, unit, range, meaning. `lagomorph info --keys` prints it and the README's
/// table is made of it.
std::string scene_key_table_markdown();

}  // namespace lagomorph::apps
