#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "apps/calibrate/calibration.h"
#include "apps/calibrate/faults.h"
#include "apps/check/mask.h"
#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/stop.h"
#include "apps/pipeline/views.h"
#include "apps/run/plan.h"
#include "apps/run/run_json.h"
#include "apps/run/state_file.h"
#include "apps/run/states_of_run.h"
#include "apps/scene/scene.h"
#include "render/color.h"
#include "render/image_compare/bias.h"
#include "render/pixels.h"

namespace lagomorph::apps {
namespace {

constexpr int other_seeds = 4;

/// Draws frames of a run anew.
class Redrawer {
public:
  Redrawer(const CalibrationRequest& request, Progress& progress)
      : paths_(request.run),
        info_(info_of(paths_)),
        scene_(load_scene(paths_.scene(), {})),
        states_(paths_, info_.identity, scene_.time.frames),
        model_(build_model(scene_, progress)),
        surfaces_(drawn_surfaces(scene_, model_, progress)),
        views_(scene_, model_, surfaces_),
        rest_(build_render_scene(scene_, model_, surfaces_)),
        threads_(request.threads) {
    scene_.render.channels.clear();
    const FrameRange all = states_.all();
    if (request.frames) {
      const FrameRange wanted = wanted_frames(request.frames, scene_.time.frames);
      for (int frame = wanted.first; frame <= wanted.last; ++frame) frames_.insert(frame);
    } else {
      frames_ = {all.first, (all.first + all.last) / 2, all.last};
    }
    for (const int frame : frames_) states_.require({frame, frame});
    if (!need_all_states(scene_)) return;
    for (const auto& [frame, record] : states_.records()) views_.see(frame, record, state(frame).q);
  }

  const std::set<int>& frames() const { return frames_; }
  const render::RenderSettings& settings() const { return scene_.render; }
  render::Camera camera(int frame) const { return views_.camera(frame, state(frame).q); }
  int threads() const { return threads_; }

  /// The meshes where they are in a frame.
  render::RenderScene scene(int frame) const {
    const sim::VecX q = state(frame).q;
    render::RenderScene drawn = rest_;
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      drawn.meshes[i].positions = to_render(surfaces_[i].positions(q));
    return drawn;
  }

  render::Picture draw(int frame, const render::RenderScene& scene, const render::RenderSettings& settings,
                       int threads) const {
    if (stop_asked()) throw Error(stop_status(), "stopped: no limits were proposed");
    const auto renderer = render::make_renderer(settings, threads);
    renderer->set_scene(scene);
    const double time = frame / scene_.time.fps;
    const sim::State shown = state(frame);
    return views_.finish(views_.draw(*renderer, {frame, time}, shown.q), shown, states_.records().at(frame));
  }

private:
  static RunInfo info_of(const RunPaths& paths) {
    std::error_code none;
    if (!std::filesystem::is_directory(paths.root(), none))
      wrong_input(fmt::format("{}: there is no such run", paths.root().string()));
    std::optional<RunInfo> info = read_run_info(paths);
    if (!info)
      wrong_input(fmt::format("{}: is no run, it has no run.json; --calibrate draws a run's states anew",
                              paths.root().string()));
    return std::move(*info);
  }

  sim::State state(int frame) const {
    return read_state(paths_.state(frame), frame, scene_.time.fps, model_.mesh().vertex_count());
  }

  RunPaths paths_;
  RunInfo info_;
  SceneDesc scene_;
  StatesOfRun states_;
  sim::Model model_;
  std::vector<sim::Surface> surfaces_;
  Views views_;
  render::RenderScene rest_;
  int threads_;
  std::set<int> frames_;
};

class Cases {
public:
  Cases(const Redrawer& redrawer, const GoldenFile& golden, const std::filesystem::path& folder,
        Progress& progress)
      : redrawer_(redrawer),
        golden_(golden),
        golden_folder_(folder),
        masks_(golden.masks),
        progress_(progress) {}

  std::vector<CalibrationCase> all() {
    for (const int frame : redrawer_.frames()) add_frame(frame);
    return std::move(cases_);
  }

private:
  void add_frame(int frame) {
    const render::RenderSettings settings = redrawer_.settings();
    const render::RenderScene scene = redrawer_.scene(frame);
    const Cluster cluster = visible_cluster(scene.meshes, redrawer_.camera(frame), frame);
    const int threads = redrawer_.threads();
    const auto draw = [&](const render::RenderScene& s, const render::RenderSettings& r, int n) {
      return redrawer_.draw(frame, s, r, n);
    };
    progress_.note(fmt::format("frame {}: as it is", frame));
    own_ = draw(scene, settings, threads);
    add(frame, threads == 1 ? "2 threads" : "1 thread", true, draw(scene, settings, threads == 1 ? 2 : 1));
    for (int i = 1; i <= other_seeds && settings.backend == "path"; ++i) {
      render::RenderSettings other = settings;
      other.path.seed += static_cast<std::uint32_t>(i);
      add(frame, fmt::format("seed {}", other.path.seed), true, draw(scene, other, threads));
    }
    if (settings.backend == "raster") {
      render::RenderSettings other = settings;
      other.raster.multisample = settings.raster.multisample == 4 ? 1 : 4;
      add(frame, fmt::format("multisample {}", other.raster.multisample), true, draw(scene, other, threads));
    }
    for (const PictureChange& change : picture_changes())
      add(frame, change.name, change.harmless, change.apply(own_));
    render::RenderScene faulty = scene;
    remove_cluster(faulty.meshes[cluster.mesh], cluster);
    add(frame, "removed cluster", false, draw(faulty, settings, threads));
    faulty = scene;
    move_cluster(faulty.meshes[cluster.mesh], cluster, redrawer_.camera(frame));
    add(frame, "moved cluster", false, draw(faulty, settings, threads));
  }

  void add(int frame, const std::string& name, bool harmless, const render::Picture& picture) {
    progress_.note(fmt::format("frame {}: {}", frame, name));
    const render::Pixels own = render::to_pixels(own_);
    render::Pixels other = render::to_pixels(picture);
    std::vector<CheckFailure> failures;
    cover(masks_.of(frame, golden_folder_ / "frames" / frame_file(frame, ".png"), own.width, own.height,
                    failures),
          own, other);
    if (!failures.empty()) wrong_input(failures.front().line());
    CalibrationCase c{.name = name, .harmless = harmless, .result = {}};
    c.result.frame = frame;
    c.result.figures = render::compare_pictures(own, other, golden_.pixels_per_degree).figures;
    c.result.bias = render::bias_figures(render::tile_bias(own, other));
    cases_.push_back(std::move(c));
  }

  const Redrawer& redrawer_;
  const GoldenFile& golden_;
  const std::filesystem::path& golden_folder_;
  Masks masks_;
  Progress& progress_;
  render::Picture own_;
  std::vector<CalibrationCase> cases_;
};

}  // namespace

std::vector<CalibrationCase> calibration_cases(const CalibrationRequest& request, const GoldenFile& golden,
                                               Progress& progress) {
  const Redrawer redrawer(request, progress);
  return Cases(redrawer, golden, request.golden, progress).all();
}

}  // namespace lagomorph::apps
