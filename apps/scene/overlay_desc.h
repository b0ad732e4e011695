#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "render/types.h"
#include "sim/types.h"

/// What a scene says of the lines and signs that are drawn over its pictures. Colours are linear RGB.
namespace lagomorph::apps {

/// Lines along the edges of a body.
struct WireframeDesc {
  bool show = false;
  std::string of = "surface";  // what is drawn of the body; "tets": the boundary of its tets
  render::Color color = render::Color(0.012F, 0.014F, 0.018F);
  double width = 1.0;           // [pixels]
  double opacity = 1.0;         // in [0, 1]
  std::string hidden = "none";  // what is behind: "none", "faint", "dashed", "all"
};

/// The rest shape of a body.
struct GhostDesc {
  std::string show = "none";  // "fill", "outline", "both"
  render::Color color = render::Color(0.10F, 0.32F, 0.72F);
  double opacity = 0.35;  // of the fill, in [0, 1]
  bool over = false;      // drawn over the bodies; false: hidden behind them
};

/// Numbers of vertices and faces.
struct LabelsDesc {
  bool vertices = false;
  bool faces = false;
  std::string of = "tets";  // or "surface", as of wireframes
  int most = 500;           // of each kind; where there are more, every second, third, ... has its number
};

/// A plane that opens the bodies: whole tets on the side that the normal points to are kept.
struct ClipDesc {
  sim::Vec3 point = sim::Vec3::Zero();  // [m], of the rest shape
  sim::Vec3 normal = sim::Vec3::UnitX();
  std::optional<render::Color> color;  // of the cut; none: the body's
};

/// Signs of what holds, pulls and moves the bodies.
struct GlyphsDesc {
  bool pins = false;            // dots
  std::string loads = "none";   // arrows: "vertices", "total"
  bool gravity = false;         // an arrow at each body's centre of mass
  int displacement_every = 0;   // arrows from rest at every so many-th vertex of the surface; 0: none
  std::optional<double> size;   // of dots and of arrows' heads [m]; none: by the size of the bodies
  std::optional<double> force;  // whose arrow is one metre long [N]; none: by the largest
  render::Color pin_color = render::Color(0.95F, 0.42F, 0.04F);
  render::Color load_color = render::Color(0.80F, 0.03F, 0.06F);
  std::string colormap = "plasma";  // of displacements, from 0 to the largest of all frames
};

/// A diagram of the energies so far.
struct EnergyPlotDesc {
  bool show = false;
  std::string place = "top_left";  // see caption_places()
  std::vector<std::string> curves = {"kinetic", "elastic", "gravitational", "total"};
  std::optional<std::array<double, 2>> range;  // of the energy axis [J]; none: by the curves of all frames
};

}  // namespace lagomorph::apps
