#include "apps/run/inputs.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "apps/file_io.h"
#include "apps/scene/keys.h"
#include "apps/scene/scene.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

fs::path real_path(const fs::path& path) {
  std::error_code error;
  fs::path result = fs::weakly_canonical(path, error);
  return error ? fs::absolute(path) : result;
}

/// The name in inputs/ of every file, by its canonical path. Files that share folder and stem (x.node, x.ele)
/// keep sharing it.
std::map<fs::path, std::string> names_of(const SceneDesc& scene) {
  std::map<fs::path, std::string> stems;  // of folder/stem
  std::set<std::string> taken;
  std::map<fs::path, std::string> names;
  for (const InputFile& input : input_files(scene)) {
    const fs::path file = real_path(input.path);
    const fs::path group = file.parent_path() / file.stem();
    if (!stems.contains(group)) {
      const std::string stem = file.stem().string();
      std::string name = stem;
      for (int n = 2; !taken.insert(name).second; ++n) name = stem + "_" + std::to_string(n);
      stems[group] = name;
    }
    names[file] = stems[group] + file.extension().string();
  }
  return names;
}

/// Gives every key that names a file its name in RUN.
class FileRenamer final : public KeyVisitor {
public:
  FileRenamer(const fs::path& directory, const std::map<fs::path, std::string>& names)
      : directory_(directory), names_(names) {}
  void table(const Table&, const Elements& elements) override {
    for (int i = 0; i < elements.size(); ++i) elements.visit(i, *this);
  }
  void key(const Key& k, Field field) override {
    if (!k.file) return;
    std::string& file = *std::get<std::string*>(field);
    const auto name = file.empty() ? names_.end() : names_.find(real_path(directory_ / file));
    if (name != names_.end()) file = "inputs/" + name->second;
  }

private:
  const fs::path directory_;
  const std::map<fs::path, std::string>& names_;
};

}  // namespace

SceneDesc self_contained(const SceneDesc& scene, const RunPaths& paths) {
  const std::map<fs::path, std::string> names = names_of(scene);
  SceneDesc result = scene;
  FileRenamer renamer(scene.directory, names);
  visit_scene(result, renamer);
  result.directory = paths.root();
  return result;
}

void write_inputs(const SceneDesc& scene, const RunPaths& paths) {
  make_folder(paths.inputs());
  std::map<std::string, std::string> contents;  // read before any is written: they may be each other's places
  for (const auto& [file, name] : names_of(scene)) contents[name] = read_file(file);
  for (const auto& [name, bytes] : contents)
    write_file_if_changed(paths.inputs() / name, bytes, Durable::yes);
  write_file_if_changed(paths.scene(), scene_to_toml(self_contained(scene, paths)), Durable::yes);
  for (const fs::directory_entry& entry : fs::directory_iterator(paths.inputs())) {
    if (entry.is_regular_file() && !contents.contains(entry.path().filename().string()))
      remove_file(entry.path());
  }
}

}  // namespace lagomorph::apps
