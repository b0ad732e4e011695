#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "apps/frame_names.h"

namespace lagomorph::apps {

/// Where everything of a run stands.
class RunPaths {
public:
  /// `names` are those of pictures and their channels; states and records have the usual ones. Of a run that
  /// is there, see paths_of_run().
  explicit RunPaths(std::filesystem::path root, FrameNames names = {})
      : root_(std::move(root)), names_(std::move(names)) {}

  const std::filesystem::path& root() const { return root_; }
  const FrameNames& names() const { return names_; }
  std::filesystem::path run_json() const { return root_ / "run.json"; }
  std::filesystem::path scene() const { return root_ / "scene.toml"; }
  std::filesystem::path energy() const { return root_ / "energy.csv"; }
  std::filesystem::path newton() const { return root_ / "newton.csv"; }
  std::filesystem::path mesh() const { return root_ / "mesh.msh"; }
  std::filesystem::path inputs() const { return root_ / "inputs"; }
  std::filesystem::path states() const { return root_ / "states"; }
  std::filesystem::path pictures() const { return root_ / "frames"; }
  std::filesystem::path records() const { return root_ / "records"; }
  std::filesystem::path channels() const { return root_ / "aov"; }
  /// Of "depth", or of "depth.exr": see channel_files().
  std::filesystem::path channel(std::string_view name) const;

  std::filesystem::path state(int frame) const;
  std::filesystem::path picture(int frame) const;
  std::filesystem::path record(int frame) const;
  std::filesystem::path channel(std::string_view name, int frame) const;
  std::filesystem::path video(const std::string& scene_name, const std::string& extension = ".mp4") const {
    return root_ / (scene_name + extension);
  }

private:
  std::filesystem::path root_;
  FrameNames names_;
};

/// "frame_0000.npy"; numbers grow past 9999.
std::string frame_file(int frame, std::string_view extension);
/// The frame of a file's name of that form; nullopt for any other name.
std::optional<int> frame_of(const std::filesystem::path& file, std::string_view extension);

}  // namespace lagomorph::apps
