#include "apps/pipeline/production.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "apps/file_io.h"
#include "apps/pipeline/build_scene.h"
#include "apps/pipeline/finish_picture.h"
#include "apps/pipeline/pipeline.h"
#include "apps/pipeline/stop.h"
#include "apps/pipeline/stopwatch.h"
#include "apps/pipeline/views.h"
#include "apps/run/disk_space.h"
#include "apps/run/gather.h"
#include "apps/run/inputs.h"
#include "apps/run/profile_table.h"
#include "apps/run/result.h"
#include "apps/run/run_json.h"
#include "apps/run/run_video.h"
#include "apps/run/state_file.h"
#include "apps/scene/idle_keys.h"
#include "apps/video/video.h"
#include "render/channel_png.h"
#include "render/channels.h"
#include "sim/integrator.h"
#include "sim/mesh_io.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The mesh of all bodies, with a physical tag per body.
std::string mesh_text(const sim::Model& model) {
  sim::TetMesh mesh = model.mesh();
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    for (int t = mesh.bodies[b].tets.begin; t < mesh.bodies[b].tets.end; ++t) {
      mesh.tags[static_cast<std::size_t>(t)] = static_cast<int>(b) + 1;
    }
  }
  return sim::write_tet_mesh(mesh, ".msh");
}

Json mesh_sizes(const sim::Model& model, const std::vector<sim::Surface>& surfaces) {
  const sim::TetMesh& mesh = model.mesh();
  Json bodies = Json::array();
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    bodies.push_back({{"name", mesh.bodies[b].name},
                      {"vertices", mesh.bodies[b].vertices.size()},
                      {"tets", mesh.bodies[b].tets.size()},
                      {"surface_vertices", surfaces[b].vertex_count()},
                      {"surface_triangles", surfaces[b].triangles().size()}});
  }
  return {{"vertices", mesh.vertex_count()}, {"tets", mesh.tet_count()}, {"bodies", std::move(bodies)}};
}

/// run.json as it will be. What is only told stays as it was where nothing is made.
RunInfo new_info(const Production& p) {
  RunInfo info = make_run_info(self_contained(p.scene, p.paths), p.identity,
                               p.renderer ? p.renderer->description() : "");
  info.names = p.paths.names();
  if (!p.contents.info) return info;
  const RunInfo& old = *p.contents.info;
  info.video = old.video;
  for (const char* key : {"mesh", "machine", "dependencies", "seconds"}) {
    if (p.jobs.empty() && old.about.contains(key)) info.about[key] = old.about[key];
  }
  return info;
}

/// Makes RUN's folder where it is not, and keeps it to us.
void take_folder(Production& p) {
  if (p.lock) return;
  make_folder(p.paths.root());
  p.lock.emplace(p.paths.root());
  p.lock->take(RunLock::Kind::exclusive);
  std::error_code unused;
  if (!fs::exists(p.paths.run_json(), unused)) return;
  throw Error(ExitStatus::wrong_input,
              p.paths.root().string() + ": another lagomorph began this run meanwhile");
}

/// Records of frames that the scene has; a run that was longer keeps its further ones on disk.
std::map<int, FrameRecord> within(const std::map<int, FrameRecord>& records, int frame_count) {
  return {records.begin(), records.lower_bound(frame_count)};
}

/// Brings what RUN says of itself up to date. run.json first: it tells the next run whose the rest is.
void prepare_folder(Production& p, RunInfo& info) {
  if (p.contents.other_pictures > 0 && info.video) {
    remove_file(p.paths.root() / fs::path(info.video->file).filename());
    info.video.reset();
  }
  write_file_if_changed(p.paths.run_json(),
                        run_json_text(info, within(p.contents.matching, p.scene.time.frames)), Durable::yes);
  write_inputs(p.scene, p.paths);
  remove_unmatched(p.paths, p.contents);
  if (p.states != nullptr) p.states->bring_to(p.paths, p.contents.matching);
}

/// Finds automatic ranges and the box that the camera is fitted to, over all states that RUN holds. False:
/// asked to stop.
bool find_ranges(const Production& p, const sim::Model& model, Views& views, Progress& progress) {
  const bool positions = views.need_positions();
  const std::map<int, FrameRecord> frames = within(p.contents.matching, p.scene.time.frames);
  if (positions) progress.begin(static_cast<int>(frames.size()), 1, "reading");
  for (const auto& [frame, record] : frames) {
    if (stop_asked()) return false;
    sim::VecX q;
    if (positions)
      q = read_state(p.paths.state(frame), frame, p.scene.time.fps, model.mesh().vertex_count()).q;
    views.see(frame, *record.state, q);
    if (positions) progress.frame_done();
  }
  progress.end();
  for (const std::string& line : views.findings()) progress.note(line);
  return true;
}

/// What is to be drawn of the frames asked for whose states are there: pictures in other ranges, or of
/// another box, are made again.
std::vector<FrameJob> pictures_in_ranges(const Production& p, const Views& views) {
  std::vector<FrameJob> jobs;
  for (int frame = p.frames.first; frame <= p.frames.last; frame += p.frames.every) {
    const auto found = p.contents.matching.find(frame);
    if (found == p.contents.matching.end()) continue;
    const FrameRecord& record = found->second;
    if (!picture_is_there(p.paths, record) || !views.drew(*record.picture))
      jobs.push_back({.frame = frame, .simulate = false, .draw = true});
  }
  return jobs;
}

/// Of jobs, whose progress is told under the name of a stage.
using Pipeline = std::function<PipelineResult(const std::vector<FrameJob>&, const std::string& stage)>;

bool draws_any(const std::vector<FrameJob>& jobs) {
  return std::any_of(jobs.begin(), jobs.end(), [](const FrameJob& job) { return job.draw; });
}

/// Where colours or the camera depend on the whole sequence: 1. all states, 2. the range, 3. the pictures.
PipelineResult simulate_then_draw(Production& p, const sim::Model& model, Views& views, const Pipeline& run,
                                  Progress& progress) {
  std::vector<FrameJob> states;
  for (const FrameJob& job : p.jobs)
    if (job.simulate) states.push_back({.frame = job.frame, .simulate = true, .draw = false});
  PipelineResult made;
  if (!states.empty()) {
    progress.note("colours, axes or camera depend on all frames: these are simulated first, then drawn");
    made = run(states, "simulating");
    made.stopped = stop_asked();
    if (made.error || made.stopped) return made;
    p.contents.matching = read_contents(p.paths, p.identity).matching;
  }
  made.stopped = !find_ranges(p, model, views, progress);
  if (made.stopped) return made;

  p.jobs = pictures_in_ranges(p, views);
  const PipelineResult drawn = run(p.jobs, "drawing");
  p.jobs.insert(p.jobs.begin(), states.begin(), states.end());
  return {made.frames + drawn.frames, made.states, drawn.pictures, made.failure, drawn.error, false};
}

/// Numbers of triangles that pictures would have no room for.
void check_png_ids(const SceneDesc& scene, const std::vector<sim::Surface>& surfaces) {
  const std::vector<std::string>& channels = scene.render.channels;
  if (scene.render.channel_format != "png" ||
      std::find(channels.begin(), channels.end(), render::triangle_id_channel) == channels.end())
    return;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].triangles().size() <= static_cast<std::size_t>(render::most_png_number)) continue;
    throw Error(
        ExitStatus::wrong_input,
        fmt::format("render.channels: 'triangle_id' of the {} triangles of '{}' does not fit into the 16 "
                    "bits of a PNG, which tell {} apart; give render.channel_format = \"npy\" or \"exr\"",
                    surfaces[i].triangles().size(), scene.body[i].physics.name, render::most_png_number));
  }
}

/// Makes the missing frames, from the model on. Up to take_folder nothing is written; nullopt when stopped
/// there.
std::optional<PipelineResult> make_frames(Production& p, RunInfo& info, Progress& progress) {
  const sim::Model model = build_model(p.scene, progress);
  const std::vector<sim::Surface> surfaces = drawn_surfaces(p.scene, model, progress);
  Views views(p.scene, model, surfaces);
  if (p.renderer) {
    check_png_ids(p.scene, surfaces);
    const render::RenderScene drawn = build_render_scene(p.scene, model, surfaces);
    render::CameraSettings camera = p.scene.camera;
    for (const CameraKey& key : p.scene.camera.key)
      camera.f_stop = std::max(camera.f_stop, key.f_stop.value_or(0.0F));
    for (const std::string& remark : render::renderer_remarks(p.scene.render, camera, drawn))
      progress.note(remark);
    for (const std::string& remark : views.remarks()) progress.note(remark);
    SceneDesc given = p.scene;
    if (p.options.half) {  // its own doing
      given.render.samples = render::RenderSettings().samples;
      given.render.path.min_samples = render::PathSettings().min_samples;
    }
    for (const std::string& line : idle_keys(given)) progress.note(line);
    p.renderer->set_scene(drawn);
  }
  const auto integrator = sim::make_integrator(p.scene.time, p.scene.solver, model);
  const ExpectedSize size =
      expected_size(p.jobs, model.mesh().vertex_count(), 1 + integrator->history_levels(), p.scene.render);
  require_space(p.paths.root(), size);
  if (!p.jobs.empty()) {
    progress.note(fmt::format("{}: {} {} to make, about {}", p.paths.root().string(), p.jobs.size(),
                              p.jobs.size() == 1 ? "frame" : "frames", size_text(size.estimate)));
  }
  info.about["mesh"] = mesh_sizes(model, surfaces);
  if (stop_asked()) return std::nullopt;

  take_folder(p);
  if (p.lock->is_exclusive()) {
    prepare_folder(p, info);
    write_file_if_changed(p.paths.mesh(), mesh_text(model), Durable::yes);
    if (p.share) p.lock->take(RunLock::Kind::shared);
  }
  const Pipeline run = [&](const std::vector<FrameJob>& jobs, const std::string& stage) {
    if (p.options.video && p.threads > 1 && draws_any(jobs))
      p.video = begin_video(p.paths, p.scene, p.contents.matching, jobs, p.frames, p.options.codec);
    return run_pipeline({p.scene, model, surfaces, views, *integrator, p.renderer.get(), p.paths, p.identity,
                         p.contents.matching, jobs, p.threads, p.options.log_newton, stage,
                         [&](int frame, render::Picture picture, const std::string& sha256) {
                           if (p.video) p.video->picture_written(frame, std::move(picture), sha256);
                         }},
                        progress);
  };
  if (p.renderer && need_all_states(p.scene)) return simulate_then_draw(p, model, views, run, progress);
  return run(p.jobs, "");
}

/// What the frames on disk and their making say of how it went. Throws what a stage threw, and
/// Error(simulation) when the simulation could not go on.
void check_made(const Production& p, const PipelineResult& made, const RunResult& result) {
  if (made.error) std::rethrow_exception(made.error);
  if (made.failure.empty()) return;
  const std::string good =
      result.records.empty() ? "none" : fmt::format("0..{}", result.records.rbegin()->first);
  throw Error(ExitStatus::simulation,
              fmt::format("{}; {} has the good frames, {}", made.failure, p.paths.root().string(), good));
}

/// run.json, energy.csv; when that fails after a stage did, the stage's failure is the one to tell.
std::map<int, FrameRecord> gather_after(const Production& p, const RunInfo& info,
                                        const PipelineResult& made) {
  try {
    return gather(p.paths, info, p.scene.time.frames);
  } catch (const Error&) {
    if (made.error) std::rethrow_exception(made.error);
    throw;
  }
}

/// 1. Makes what is missing, 2. gathers, 3. makes the video.
ExitStatus make_all(Production& p, RunResult& result, Progress& progress) {
  RunInfo info = new_info(p);
  std::optional<PipelineResult> made;
  std::error_code unused;
  const bool find_range = p.renderer && need_all_states(p.scene);
  if (!p.jobs.empty() || find_range || !fs::exists(p.paths.mesh(), unused)) {
    made = make_frames(p, info, progress);
    if (!made) return stop_status();
  } else {
    if (p.lock->is_exclusive()) prepare_folder(p, info);
    made.emplace();
  }
  result.begun = true;
  if (!p.jobs.empty()) info.about["seconds"] = stage_seconds(sim::profile());
  result.records = gather_after(p, info, *made);
  result.states_made = made->states;
  result.pictures_made = made->pictures;
  check_made(p, *made, result);
  if (made->stopped || made->frames < static_cast<int>(p.jobs.size())) return stop_status();

  if (p.options.video && p.renderer) {
    std::optional<VideoUpdate> video = update_video(p.paths, p.scene, result.records, p.frames,
                                                    p.options.codec, info.video, p.video.get(), stop_asked);
    if (!video) return stop_status();
    result.video = video->record.file;
    result.video_made = video->made;
    if (const std::string remark = rate_remark(p.options.codec, p.scene.time.fps / p.frames.every);
        video->made && !remark.empty())
      progress.note(remark);
    result.video_replaced = video->replaced;
    info.video = std::move(video->record);
    gather(p.paths, info, p.scene.time.frames);
  }
  return ExitStatus::done;
}

/// Of those asked for: states, and pictures where some are drawn.
std::string what_is_there(const Production& p, const RunResult& result) {
  int frames = 0, pictures = 0;
  for (int frame = p.frames.first; frame <= p.frames.last; frame += p.frames.every) {
    const auto found = result.records.find(frame);
    if (found == result.records.end()) continue;
    ++frames;
    pictures += found->second.picture ? 1 : 0;
  }
  const auto of_all = [&](int n, const char* what) {
    return fmt::format("{} of {} {}{}", n, p.frames.count(), what, p.frames.count() == 1 ? "" : "s");
  };
  if (p.states != nullptr) return of_all(pictures, "picture");
  return of_all(frames, "frame") + (p.renderer ? fmt::format(" and {}", of_all(pictures, "picture")) : "");
}

}  // namespace

ExitStatus produce(Production p, Progress& progress) {
  const Stopwatch watch;
  RunResult result;
  result.run = p.paths.root();
  result.frames = p.frames.count();
  const auto tell = [&](const char* status, const std::string& reason) {
    result.status = status;
    result.reason = reason;
    result.seconds = watch.seconds();
    if (p.options.json) std::fputs(result_json(result).c_str(), stdout);
  };
  try {
    const ExitStatus status = make_all(p, result, progress);
    if (status == ExitStatus::done) {
      tell("done", "");
      progress.note(result_text(result));
      if (p.options.profile) std::fputs(profile_table(sim::profile(), result.seconds).c_str(), stderr);
    } else {
      const std::string line = fmt::format("interrupted with {} there; the same command goes on from there",
                                           what_is_there(p, result));
      tell("interrupted", line);
      std::fprintf(stderr, "lagomorph: %s\n", line.c_str());
    }
    return status;
  } catch (const std::exception& e) {
    if (result.begun) tell("failed", e.what());
    throw;
  }
}

void check_camera(const SceneDesc& scene) {
  const render::Camera camera(CameraMoves(scene.camera, scene.time, 1.0).at(0, std::nullopt),
                              scene.render.width, scene.render.height);
}

int thread_count(const Options& options) {
  if (options.threads > 0) return options.threads;
  const unsigned cores = std::thread::hardware_concurrency();
  return cores > 0 ? static_cast<int>(cores) : 1;
}

}  // namespace lagomorph::apps
