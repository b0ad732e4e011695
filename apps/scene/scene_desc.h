#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/overlay_desc.h"
#include "render/atmosphere.h"
#include "render/camera.h"
#include "render/render_scene.h"
#include "render/settings.h"
#include "sim/settings.h"

namespace lagomorph::apps {

/// What of a body is drawn.
struct SurfaceDesc {
  std::string
      mesh;  // fine mesh to embed (OBJ, OFF, PLY, STL), placed as the body is; empty: the tets' boundary
  double max_outside =
      0.01;  // of the body's bounding-box diagonal; a fine vertex further outside of the tets is an error
  bool smooth = true;  // smooth normals; false: one a triangle
  bool flip = false;   // its other side is the outside
  bool fill = true;    // false: only its lines are drawn
};

/// A scalar field of a body's state, shown in the colours of its surface.
struct ShownField {
  std::string field = "none";                  // see sim::field_table()
  std::string colormap = "auto";               // see render::colormap_names(); auto: the field's own
  std::optional<std::array<double, 2>> range;  // low < high; none: that of the whole sequence
  bool color_bar = true;                       // in the picture
};

struct BodyDesc {
  sim::BodySettings physics;
  std::string mesh;              // tet mesh; relative to the scene file (or to RUN, for RUN/scene.toml)
  std::string element = "mesh";  // what the mesh has; or "linear", "quadratic": made so as it is read
  SurfaceDesc surface;           // [body.surface]
  render::Material look;         // [body.look]
  ShownField shown;              // likewise
  WireframeDesc wireframe;       // [body.wireframe]
  GhostDesc ghost;               // [body.ghost]
  LabelsDesc labels;             // [body.labels]
  // "a.toml:12:1: body.0.pin.0": where each stands, for errors
  std::vector<std::string> pin_places, spring_places, load_places;
};

/// A light of a scene: a rectangle or a sun.
struct LightDesc : render::AreaLight {
  std::string kind = "area";
  render::Vec3 direction = render::Sun().direction;  // these of a sun
  float angle = render::Sun().angle;
  float irradiance = render::Sun().irradiance;
};

/// Light from all around: a gradient, a clear sky with its sun, or a picture.
struct SkyDesc : render::Sky {
  std::string model = "gradient";
  std::string image;      // .hdr, relative to the scene file; given, it stands for the model
  float rotation = 0.0F;  // of the image's middle, see SkyMap [degrees]
  render::Atmosphere atmosphere;
};

/// What is written over the pictures.
struct CaptionDesc {
  std::string text;  // see caption_text(); empty: nothing
  std::string place = "bottom_left";
};

/// A scene file as plain values, every default filled in. What the file says, not yet what it makes.
struct SceneDesc {
  std::string name;
  sim::TimeSettings time;                   // [time]
  sim::SolverSettings solver;               // [solver]
  std::vector<BodyDesc> body;               // [[body]]
  render::CameraSettings camera;            // [camera]
  render::RenderSettings render;            // [render], [render.raster], [render.path]
  render::Ground ground;                    // [ground]
  std::vector<LightDesc> light;             // [[light]]; none in the file: one key light by default
  SkyDesc sky;                              // [sky]
  CaptionDesc caption;                      // [caption]
  std::optional<ClipDesc> clip;             // [clip]
  GlyphsDesc glyphs;                        // [glyphs]
  EnergyPlotDesc energy_plot;               // [energy_plot]
  std::optional<render::Color> background;  // [background] color = [r, g, b], linear
  std::filesystem::path directory;          // of the scene file: what relative paths in it are relative to
};

}  // namespace lagomorph::apps
