#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/camera.h"
#include "render/raster/gl_context.h"
#include "render/raster/gl_objects.h"
#include "render/raster/mesh_buffers.h"
#include "render/render_scene.h"

namespace lagomorph::bench {

/// The main job's scene as a plain forward renderer draws it with the same OSMesa: mesh and ground in one
/// pass of four samples, GGX, two lights that are points to their material, each with a shadow map in which
/// `taps` places are compared, one ambient colour, and what was drawn read back.
class ForwardFrame {
public:
  static constexpr int taps = 16;  // 0 without shadows

  /// Of a scene with one mesh, a ground and two lights.
  ForwardFrame(const render::RenderScene&, int width, int height, int threads, bool shadows);
  ~ForwardFrame();
  ForwardFrame(const ForwardFrame&) = delete;
  ForwardFrame& operator=(const ForwardFrame&) = delete;

  /// RGBA, rows from below.
  const std::vector<float>& draw_and_read(const render::Camera&);

private:
  static constexpr int map_size = 2048;  // the main job's

  struct Gl {
    explicit Gl(bool shadows);
    struct Target {
      render::raster::Renderbuffer color, depth;
      render::raster::Framebuffer framebuffer;
    };
    struct Map {
      render::raster::Texture depth;
      render::raster::Framebuffer framebuffer;
    };
    Target single, several;
    std::array<Map, 2> maps;
    std::optional<render::raster::MeshBuffers> mesh;
    render::raster::VertexArray no_attributes;
    render::raster::Program shade_mesh, shade_ground, depth_only;
  };

  void draw_maps(std::array<render::Mat4, 2>& map_from_world);
  void draw_picture(const render::Camera&, const std::array<render::Mat4, 2>& map_from_world);

  render::RenderScene scene_;
  int width_, height_;
  bool shadows_;
  std::unique_ptr<render::raster::GlContext> context_;
  std::unique_ptr<Gl> gl_;
  std::vector<float> pixels_;
};

}  // namespace lagomorph::bench
