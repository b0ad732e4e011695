#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "apps/hash.h"
#include "apps/scene/camera_moves.h"
#include "apps/scene/keys.h"
#include "apps/scene/scene.h"
#include "apps/scene/values.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

/// A visitor that knows the path of the key it is shown.
class PathVisitor : public KeyVisitor {
public:
  void table(const Table& about, const Elements& elements) override {
    const std::string path = path_of(about.name);
    const int size = elements.size();
    for (int i = 0; i < size; ++i) {
      const bool list = elements.kind == Elements::Kind::list;
      const std::string outer = std::exchange(path_, list ? fmt::format("{}.{}", path, i) : path);
      elements.visit(i, *this);
      path_ = outer;
    }
  }

protected:
  std::string path_of(const char* name) const { return path_.empty() ? name : path_ + "." + name; }

private:
  std::string path_;
};

std::vector<fs::path> files_of(const SceneDesc& scene, const std::string& name) {
  if (name.empty()) return {};
  return mesh_files(fs::absolute(scene.directory / name).lexically_normal());
}

class FileCollector : public PathVisitor {
public:
  explicit FileCollector(const SceneDesc& scene) : scene_(scene) {}
  std::vector<InputFile> files;
  void key(const Key& k, Field field) override {
    if (!k.file) return;
    for (const fs::path& file : files_of(scene_, *std::get<std::string*>(field))) {
      const bool known =
          std::any_of(files.begin(), files.end(), [&](const InputFile& f) { return f.path == file; });
      if (!known) files.push_back({path_of(k.name), file});
    }
  }

private:
  const SceneDesc& scene_;
};

/// Whether the presence of a table's elements is of the simulation or of the pictures: of the simulation
/// where any of their keys is. Leaves the table as it is.
Part part_of(const Elements& elements) {
  class Parts : public KeyVisitor {
  public:
    Part part = Part::none;
    void key(const Key& k, Field) override {
      if (k.part == Part::simulation || part == Part::none) part = k.part;
    }
    void table(const Table&, const Elements& inner) override {
      if (inner.kind == Elements::Kind::one) inner.visit(0, *this);
    }
  } parts;
  const int size = elements.size();
  if (size == 0) elements.resize(1);
  elements.visit(0, parts);
  if (size == 0) elements.resize(0);
  return parts.part;
}

using TableSizes = std::map<std::string, int>;  // by path, of the tables whose size is free

/// Collects the sizes of tables, and gives them those of another scene where these are given.
class Sizes : public PathVisitor {
public:
  explicit Sizes(const TableSizes* wanted = nullptr) : wanted_(wanted) {}
  TableSizes found;

  void key(const Key&, Field) override {}
  void table(const Table& about, const Elements& elements) override {
    if (elements.kind != Elements::Kind::one) {
      const std::string path = path_of(about.name);
      found[path] = elements.size();
      if (wanted_ != nullptr) elements.resize(wanted_->at(path));
    }
    PathVisitor::table(about, elements);
  }

private:
  const TableSizes* wanted_;
};

/// The keys of a part, and the sizes of tables.
class PartCollector : public PathVisitor {
public:
  PartCollector(const SceneDesc& scene, Part part, const TableSizes& sizes)
      : scene_(scene), part_(part), sizes_(sizes) {}
  std::vector<ResolvedKey> keys;

  void key(const Key& k, Field field) override {
    if (k.part != part_) return;
    std::string value = toml_value(field).value_or("not given");
    if (k.file) value = contents(*std::get<std::string*>(field));
    keys.push_back({path_of(k.name), value});
  }
  void table(const Table& about, const Elements& elements) override {
    if (elements.kind != Elements::Kind::one && part_of(elements) == part_) {
      const std::string path = path_of(about.name);
      keys.push_back({path, fmt::format("{} of them", sizes_.at(path))});
    }
    PathVisitor::table(about, elements);
  }

private:
  /// A file by what is in it, so that a moved one is the same.
  std::string contents(const std::string& name) const {
    std::string hashes;
    for (const fs::path& file : files_of(scene_, name)) hashes += " sha256:" + sha256_file(file);
    return hashes.empty() ? toml_string("") : hashes.substr(1);
  }

  const SceneDesc& scene_;
  Part part_;
  const TableSizes& sizes_;
};

/// A key that comes later, and is not used, leaves older runs and references what they are.
std::vector<ResolvedKey> keys_of(const SceneDesc& scene, Part part) {
  SceneDesc shown = scene, plain = default_scene();
  Sizes sizes;
  visit_scene(shown, sizes);
  Sizes plain_sizes(&sizes.found);
  visit_scene(plain, plain_sizes);

  PartCollector collected(scene, part, sizes.found), defaults(scene, part, plain_sizes.found);
  visit_scene(shown, collected);
  visit_scene(plain, defaults);
  std::vector<ResolvedKey> keys;
  for (std::size_t i = 0; i < collected.keys.size(); ++i) {
    if (collected.keys[i].value != defaults.keys[i].value) keys.push_back(std::move(collected.keys[i]));
  }
  return keys;
}

}  // namespace

std::vector<ResolvedKey> simulation_keys(const SceneDesc& scene) { return keys_of(scene, Part::simulation); }

std::vector<ResolvedKey> picture_keys(const SceneDesc& scene) {
  std::vector<ResolvedKey> keys = keys_of(scene, Part::picture);
  if (depends_on_frame_count(scene)) keys.push_back({"time.frames", std::to_string(scene.time.frames)});
  return keys;
}

std::vector<fs::path> mesh_files(const fs::path& mesh) {
  if (mesh.extension() != ".node" && mesh.extension() != ".ele") return {mesh};
  return {fs::path(mesh).replace_extension(".node"), fs::path(mesh).replace_extension(".ele")};
}

std::vector<InputFile> input_files(const SceneDesc& scene) {
  SceneDesc shown = scene;
  FileCollector collector(scene);
  visit_scene(shown, collector);
  return collector.files;
}

}  // namespace lagomorph::apps
