#include "render/raster/scene_shapes.h"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace lagomorph::render::raster {

void SceneShapes::set_scene(const RenderScene& scene, const DrawnByRays& by_rays) {
  meshes_.clear();
  for (std::size_t k = 0; k < scene.meshes.size(); ++k)
    meshes_.emplace_back(scene.meshes[k], by_rays.meshes[k].behind);
}

bool SceneShapes::any(bool (MeshBuffers::*is)() const) const {
  return std::any_of(meshes_.begin(), meshes_.end(), std::mem_fn(is));
}

bool SceneShapes::all(bool (MeshBuffers::*are)() const) const {
  return std::all_of(meshes_.begin(), meshes_.end(), std::mem_fn(are));
}

void SceneShapes::draw_meshes(const Program& program, Which which) const {
  program.use();
  GLuint surface = 1;
  for (const MeshBuffers& mesh : meshes_) {
    const GLuint number = surface++;
    if (which != Which::all && mesh.see_through() != (which == Which::see_through)) continue;
    if (which == Which::solid && mesh.clear()) continue;
    mesh.closed() && which != Which::see_through ? glEnable(GL_CULL_FACE) : glDisable(GL_CULL_FACE);
    glUniform1ui(program.location("surface"), number);
    glUniform1i(program.location("is_smooth"), mesh.smooth() ? 1 : 0);
    glUniform1i(program.location("is_colored"), mesh.colored() ? 1 : 0);
    glUniform1i(program.location("moves"), mesh.moves() ? 1 : 0);
    mesh.draw();
  }
}

void SceneShapes::draw_ground(const Program& program) const {
  program.use();
  glDisable(GL_CULL_FACE);
  glBindVertexArray(no_attributes_.id());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void SceneShapes::draw_lights(const Program& program, const std::vector<AreaLight>& lights) const {
  program.use();
  glEnable(GL_CULL_FACE);
  glBindVertexArray(no_attributes_.id());
  const auto set = [&](const char* name, const Vec3& v) {
    glUniform3f(program.location(name), v.x(), v.y(), v.z());
  };
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightFrame frame = light_frame(lights[i]);
    set("middle", lights[i].position);
    set("half_right", 0.5F * lights[i].size.x() * frame.right);
    set("half_up", 0.5F * lights[i].size.y() * frame.up);
    glUniform1ui(program.location("surface"), static_cast<GLuint>(1 + meshes_.size() + i));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
}

void SceneShapes::draw_full_screen() const {
  glBindVertexArray(no_attributes_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace lagomorph::render::raster
