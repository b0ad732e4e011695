#include "apps/pipeline/build_scene.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/pipeline/painted_fields.h"
#include "apps/pipeline/recordings.h"
#include "apps/scene/panels.h"
#include "apps/scene/shutter.h"
#include "render/albedo.h"
#include "render/atmosphere.h"
#include "render/error.h"
#include "render/hdr.h"
#include "sim/error.h"
#include "sim/mesh_io.h"
#include "sim/pins.h"
#include "sim/placement.h"
#include "sim/refine.h"

namespace lagomorph::apps {
namespace {

std::string size_of(const sim::Points& X) {
  const sim::Vec3 size = (X.colwise().maxCoeff() - X.colwise().minCoeff()).transpose();
  return fmt::format("{:.3g} x {:.3g} x {:.3g} m", size.x(), size.y(), size.z());
}

void note_all(Progress& progress, const std::string& origin, const sim::Remarks& remarks) {
  for (const std::string& remark : remarks) {
    progress.note(remark.starts_with(origin) ? remark : fmt::format("{}: {}", origin, remark));
  }
}

sim::TriMesh read_fine_mesh(const BodyDesc& body, const std::filesystem::path& file, Progress& progress) {
  sim::Remarks remarks;
  sim::TriMesh fine = sim::read_tri_mesh(file, remarks);
  sim::place(fine.X, body.physics);
  progress.note(fmt::format("{}: {} vertices, {} triangles, {} as placed", file.string(), fine.X.rows(),
                            fine.triangles.size(), size_of(fine.X)));
  note_all(progress, file.string(), remarks);
  return fine;
}

/// The fine mesh that a body carries.
sim::Surface embedded_surface(const SceneDesc& scene, const sim::Model& model, std::size_t index,
                              Progress& progress) {
  const BodyDesc& body = scene.body[index];
  const std::filesystem::path file = scene.directory / body.surface.mesh;
  const sim::TriMesh fine = read_fine_mesh(body, file, progress);
  try {
    sim::Surface surface =
        sim::Surface::embedded(model.mesh(), static_cast<int>(index), fine, body.surface.max_outside);
    if (surface.outside_count() > 0) {
      progress.note(fmt::format("{}: {} vertices lie outside of the tets, by {:.2g} m at most", file.string(),
                                surface.outside_count(), surface.outside_distance()));
    }
    return surface;
  } catch (const sim::InputError& e) {
    throw sim::InputError(file.string() + ": " + e.what());
  }
}

sim::Surface smooth_surface(const sim::Surface& coarse, const std::string& body, int levels,
                            Progress& progress) {
  try {
    sim::Surface fine = coarse.subdivided(levels);
    std::string creases;
    if (fine.open_edges() > 0) creases = fmt::format("; its {} open edges stay a border", fine.open_edges());
    if (fine.crease_edges() > 0)
      creases += fmt::format("; {} edges of three or more triangles stay creases", fine.crease_edges());
    progress.note(fmt::format("{}: surface subdivided from {} to {} triangles{}", body,
                              coarse.triangles().size(), fine.triangles().size(), creases));
    return fine;
  } catch (const sim::InputError& e) {
    throw sim::InputError(fmt::format("surface.subdivide of body '{}': {}", body, e.what()));
  }
}

/// The picture of a sky around; messages name the file.
render::SkyMap read_sky(const std::filesystem::path& file, float rotation) {
  const std::string bytes = read_file(file);
  try {
    render::HdrPicture picture =
        render::read_hdr({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
    return {picture.width, picture.height, std::move(picture.texels), rotation};
  } catch (const render::SettingsError& e) {
    throw Error(ExitStatus::wrong_input, fmt::format("{}: {}", file.string(), e.what()));
  }
}

/// The sky, and the sun in it.
void light_by_sky(const SceneDesc& scene, render::RenderScene& drawn) {
  drawn.sky = scene.sky;
  if (!scene.sky.image.empty()) {
    drawn.sky.map = std::make_shared<const render::SkyMap>(
        read_sky(scene.directory / scene.sky.image, scene.sky.rotation));
  } else if (scene.sky.model == "physical") {
    drawn.sky.map = std::make_shared<const render::SkyMap>(render::atmosphere_map(scene.sky.atmosphere));
    render::Sun sun = render::atmosphere_sun(scene.sky.atmosphere);
    sun.irradiance = scene.sky.strength;
    sun.name = "the sky's sun";
    drawn.suns.push_back(sun);
  }
}

/// Selections are told here with their place in the scene. The recorded paths of the pins.
std::vector<sim::Recording> select_and_read_paths(const std::filesystem::path& directory,
                                                  const BodyDesc& body, const sim::Points& placed) {
  std::vector<sim::Recording> paths;
  for (std::size_t i = 0; i < body.physics.pin.size(); ++i) {
    const sim::PinSettings& pin = body.physics.pin[i];
    const std::vector<int> selected = sim::select_vertices(placed, pin, body.pin_places[i]);
    paths.push_back(pin.path.empty() ? sim::Recording{} : read_path(directory / pin.path, selected.size()));
  }
  for (std::size_t i = 0; i < body.physics.spring.size(); ++i)
    sim::select_vertices(placed, body.physics.spring[i], body.spring_places[i]);
  for (std::size_t i = 0; i < body.physics.load.size(); ++i)
    if (!body.physics.load[i].is_empty())
      sim::select_vertices(placed, body.physics.load[i], body.load_places[i]);
  return paths;
}

}  // namespace

std::vector<sim::BodyInput> read_bodies(const SceneDesc& scene, Progress& progress) {
  std::vector<sim::BodyInput> bodies;
  for (const BodyDesc& body : scene.body) {
    const std::filesystem::path file = scene.directory / body.mesh;
    sim::Remarks remarks;
    sim::TetMesh mesh = sim::read_tet_mesh(file, remarks);
    if (body.element == "linear") mesh = sim::with_linear_tets(mesh);
    if (body.element == "quadratic") mesh = sim::with_quadratic_tets(mesh);
    sim::Points placed = mesh.X;
    sim::place(placed, body.physics);
    progress.note(fmt::format("{}: {} {}, {} tets, {} as placed", file.string(), mesh.vertex_count(),
                              mesh.midsides.empty() ? "vertices" : "corners and midside nodes",
                              mesh.tet_count(), size_of(placed)));
    note_all(progress, file.string(), remarks);
    sim::BodyInput input{std::move(mesh), body.physics};
    if (!body.physics.velocities.empty())
      input.velocities = read_velocities(scene.directory / body.physics.velocities, placed.rows());
    input.recordings = select_and_read_paths(scene.directory, body, placed);
    for (sim::FieldSettings& field : input.settings.field) read_painted(scene.directory, field);
    bodies.push_back(std::move(input));
  }
  return bodies;
}

sim::Model build_model(const SceneDesc& scene, Progress& progress) {
  return {read_bodies(scene, progress), scene.time.gravity};
}

std::vector<sim::Surface> build_surfaces(const SceneDesc& scene, const sim::Model& model,
                                         Progress& progress) {
  std::vector<sim::Surface> surfaces;
  for (std::size_t i = 0; i < scene.body.size(); ++i) {
    const BodyDesc& body = scene.body[i];
    const int index = static_cast<int>(i);
    surfaces.push_back(body.surface.mesh.empty() ? sim::Surface::boundary(model.mesh(), index)
                                                 : embedded_surface(scene, model, i, progress));
    if (body.surface.subdivide > 0)
      surfaces.back() = smooth_surface(surfaces.back(), body.physics.name, body.surface.subdivide, progress);
  }
  return surfaces;
}

std::vector<sim::Surface> drawn_surfaces(const SceneDesc& scene, const sim::Model& model,
                                         Progress& progress) {
  if (!scene.clip) return build_surfaces(scene, model, progress);
  std::vector<sim::Surface> surfaces;
  bool any = false;
  for (int i = 0; i < static_cast<int>(scene.body.size()); ++i) {
    const sim::TetMesh kept = sim::kept_part(model.mesh(), i, scene.clip->point, scene.clip->normal);
    surfaces.push_back(sim::Surface::part(model.mesh(), i, kept));
    any = any || kept.tet_count() > 0;
  }
  if (any) return surfaces;
  throw Error(ExitStatus::wrong_input,
              "clip leaves nothing: no tet of any body is on the side that clip.normal points to");
}

std::vector<render::Vec3> to_render(const sim::Points& points) {
  std::vector<render::Vec3> positions(static_cast<std::size_t>(points.rows()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = points.row(static_cast<Eigen::Index>(i)).transpose().cast<float>();
  }
  return positions;
}

render::Triangle to_render(const sim::Triangle& t) {
  return {static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
          static_cast<std::uint32_t>(t[2])};
}

std::vector<render::Color> plain_colors(const SceneDesc& scene, const sim::Surface& surface,
                                        std::size_t body) {
  const render::Material& look = scene.body[body].look;
  std::vector<render::Color> colors(static_cast<std::size_t>(surface.vertex_count()),
                                    look.transmission > 0.0F ? render::albedo(look) : look.base_color);
  if (scene.clip && scene.clip->color)
    std::fill(colors.begin() + surface.first_cut_vertex(), colors.end(), *scene.clip->color);
  return colors;
}

render::RenderScene build_render_scene(const SceneDesc& scene, const sim::Model& model,
                                       const std::vector<sim::Surface>& surfaces) {
  const sim::VecX X = model.initial_state().q;
  render::RenderScene drawn;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    render::Mesh mesh;
    mesh.name = model.mesh().bodies[i].name;
    const SurfaceDesc& shown = scene.body[i].surface;
    for (const sim::Triangle& t : surfaces[i].triangles()) {
      if (!shown.fill) break;
      mesh.triangles.push_back(to_render(t));
      if (shown.flip) std::swap(mesh.triangles.back()[1], mesh.triangles.back()[2]);
    }
    mesh.positions = to_render(surfaces[i].positions(X));
    mesh.material = scene.body[i].look;
    if (shows_field(scene, i) || (scene.clip && scene.clip->color))
      mesh.colors = plain_colors(scene, surfaces[i], i);          // until a state is shown
    if (!mesh.colors.empty()) mesh.material.transmission = 0.0F;  // else they would not be seen
    mesh.smooth = scene.body[i].surface.smooth;
    mesh.body_id = static_cast<int>(i);
    drawn.meshes.push_back(std::move(mesh));
  }
  drawn.ground = scene.ground;
  for (std::size_t i = 0; i < scene.light.size(); ++i) {
    const LightDesc& light = scene.light[i];
    const std::string name = fmt::format("light.{}", i);
    if (light.kind == "sun") {
      drawn.suns.push_back(
          {light.direction.normalized(), light.angle, light.color, light.irradiance, light.visible, name});
    } else {
      drawn.lights.push_back(light);
      drawn.lights.back().name = name;
    }
  }
  light_by_sky(scene, drawn);
  drawn.motion_segments = scene.camera.shutter > 0.0F ? motion_segments : 0;
  drawn.background = scene.background;
  return drawn;
}

bool draws_motion(const SceneDesc& scene) {
  const std::vector<std::string>& channels = scene.render.channels;
  return scene.camera.shutter > 0.0F ||
         std::find(channels.begin(), channels.end(), render::motion_channel) != channels.end();
}

void move_meshes(render::Renderer& renderer, const std::vector<sim::Surface>& surfaces, const sim::VecX& q,
                 const Motion* motion) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const std::vector<render::Vec3> close = to_render(surfaces[i].positions(q));
    renderer.update_positions(static_cast<int>(i), close);
    if (motion == nullptr) continue;
    renderer.set_previous(static_cast<int>(i), to_render(surfaces[i].positions(motion->before)));
    if (motion->open.empty()) continue;
    std::vector<std::vector<render::Vec3>> open;
    for (const sim::VecX& x : motion->open) open.push_back(to_render(surfaces[i].positions(x)));
    renderer.set_motion(static_cast<int>(i), open);
  }
}

}  // namespace lagomorph::apps
