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
  int subdivide = 0;              // how often by Loop's scheme
  bool smooth = true;             // smooth normals; false: one a triangle
  bool flip = false;              // its other side is the outside
  bool fill = true;               // false: only its lines are drawn
  bool face_orientation = false;  // its outside and inside are tinted
};

/// A scalar field of a body's state, shown in the colours of its surface.
struct ShownField {
  std::string field = "none";                  // see sim::field_table()
  std::string colormap = "auto";               // see render::colormap_names(); auto: the field's own
  std::optional<std::array<double, 2>> range;  // low < high; none: that of the whole sequence
  bool color_bar = true;                       // in the picture

  bool is_none() const { return field == "none"; }
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

/// The camera at a time. What a key leaves open passes through the keys that give it.
struct CameraKey {
  std::optional<double> time;   // [s], or
  std::optional<double> frame;  // its number
  std::optional<sim::Vec3> position, look_at, up;
  std::optional<float> fov, orthographic, zoom, focus_distance, f_stop;
};

/// A camera that goes around look_at, about +y.
struct TurntableDesc {
  std::optional<double> turns;   // over time.frames, so that the frame after the last is the first; or
  std::optional<double> period;  // of a turn [s]; below 0 clockwise, seen from above
  double start = 0.0;            // [degrees]
};

/// The camera, and how it moves.
struct CameraDesc : render::CameraSettings {
  std::string view = "none";    // see camera_views(); the side that it looks from
  std::string frame = "none";   // see camera_frames(); what it is aimed at and fitted to
  std::string follow = "none";  // or "center_of_mass"
  float margin = 0.05F;         // of a fitted view, of the picture on each side
  float zoom = 1.0F;            // of all that is above
  std::string interpolation = "smooth";
  std::vector<CameraKey> key;
  TurntableDesc turntable;
};

/// One of several pictures in a picture: the scene with another camera or field.
struct PanelDesc {
  std::string title;
  std::string view = "same", frame = "same";  // these as the camera's where they are the same, or not given
  std::optional<sim::Vec3> position, look_at, up;
  std::optional<float> fov, orthographic, zoom;
  std::string field = "same", colormap = "same";  // of all bodies
  std::optional<std::array<double, 2>> range;
};

/// How panels are laid out.
struct LayoutDesc {
  int columns = 0;  // 0: one row of up to 3 panels, else as near to a square as can be
  int gap = 4;      // between panels [pixels]
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
  CameraDesc camera;                        // [camera]
  std::vector<PanelDesc> panel;             // [[panel]]; none: the picture is one
  LayoutDesc layout;                        // [layout]
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
