#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/types.h"

/// What a scene says of the physics, as plain structs with defaults. SI units. Names are those of the scene
/// file.
namespace lagomorph::sim {

/// Fibres that a material holds; see Fibre.
struct FibreSettings {
  Vec3 direction = Vec3::Zero();  // of the rest shape as it is placed, of any length but 0
  double stiffness = 0.0;         // what they add to the modulus along themselves at rest [Pa], > 0
  double exponent = 0.0;          // how they stiffen with the stretch, >= 0; 0 not
  bool compression = false;       // they push too; else slack fibres do nothing
};

/// Give (young, poisson), or (mu, lambda), or for `neo_hookean` (C, D), for `mooney_rivlin` (C10, C01, bulk),
/// or a preset. With none, young = 1e5 Pa and poisson = 0.3. What is given goes before the preset's.
struct MaterialSettings {
  std::string model = "stable_neo_hookean";  // see material_names()
  std::string preset = "none";               // see material_preset_names(): young and poisson by name
  std::optional<double> young;               // Young's modulus [Pa], > 0
  std::optional<double> poisson;             // Poisson's ratio, in (-1, 0.5)
  std::optional<double> mu;                  // shear modulus [Pa], > 0
  std::optional<double> lambda;              // Lamé's first parameter [Pa]
  std::string moduli = "lecture";            // of neo_hookean, D = lambda/2; "matched": (lambda + 2mu/3)/2
  std::optional<double> C;                   // lecture's C = mu/2 [Pa]
  std::optional<double> D;                   // lecture's D = lambda/2 [Pa]
  std::optional<double> C10;                 // of mooney_rivlin [Pa], >= 0
  std::optional<double> C01;                 // of mooney_rivlin [Pa], >= 0
  std::optional<double> bulk;                // bulk modulus of mooney_rivlin [Pa], >= 0
  std::vector<std::array<double, 2>> data;   // of stress_strain: (strain, stress) [1, Pa], nominal
  std::optional<FibreSettings> fibre;
};

struct BoxSelector {
  Vec3 min, max;  // [m], inclusive
};
struct SphereSelector {
  Vec3 center;    // [m]
  double radius;  // [m]
};
/// Vertices on the side of the plane that the normal points away from are not selected: (X - point)·normal >=
/// 0 is.
struct PlaneSelector {
  Vec3 point;   // [m]
  Vec3 normal;  // need not be of unit length
};

/// Vertices of a body: the union of what is given.
struct Selector {
  std::vector<int> vertices;             // 0-based, in file order, per body
  std::optional<BoxSelector> box;        // of rest positions, after the body is placed
  std::optional<SphereSelector> sphere;  // likewise
  std::optional<PlaneSelector> plane;    // likewise
  std::optional<double> top;             // upper fraction of the rest bounding box along +y, in (0, 1]
  std::optional<double> bottom;          // lower fraction, in (0, 1]

  bool is_empty() const { return vertices.empty() && !box && !sphere && !plane && !top && !bottom; }
};

/// Where a pin's vertices are at a time: x = center + translate + R(rotate) scale (X - center).
struct PinKey {
  double time = 0.0;              // [s], >= 0
  Vec3 translate = Vec3::Zero();  // [m]
  Vec3 rotate = Vec3::Zero();     // Euler angles about the fixed x, then y, then z axis [degrees]
  double scale = 1.0;             // > 0
};

/// Vertices held where they are at the start, or driven by keys or a recorded path.
struct PinSettings : Selector {
  std::vector<std::string> axes = {"x", "y", "z"};  // that are held; the others are free
  std::string interpolation = "smooth";             // "smooth": once differentiable; "linear"
  std::optional<Vec3> center;                       // of keys; none: the mean of the vertices at rest [m]
  std::string path;                // file of the recorded path; whoever reads it fills in a Recording
  std::optional<double> path_fps;  // samples a second of it [1/s], > 0
  std::optional<double> release;   // from then on the vertices are free [s], > 0
  std::vector<PinKey> key;         // times ascend; before the first and after the last they rest
};

/// A spring from each selected vertex to a point: k/2 (|x - p| - rest_length)².
struct SpringSettings : Selector {
  double stiffness = 0.0;    // of each vertex's own spring [N/m], > 0
  std::optional<Vec3> to;    // p of all [m]; none: each vertex's rest position
  double rest_length = 0.0;  // [m], >= 0
};

/// Forces on the selected vertices, or on the whole body where nothing is selected, times a factor of time.
struct LoadSettings : Selector {
  Vec3 force = Vec3::Zero();         // in all, in equal parts to the vertices [N]
  Vec3 traction = Vec3::Zero();      // on boundary triangles with all corners selected, per rest area [N/m^2]
  double pressure = 0.0;             // likewise, against their outward normal at rest: a dead load [Pa]
  Vec3 body_force = Vec3::Zero();    // on tets with all corners selected, per rest volume [N/m^3]
  Vec3 acceleration = Vec3::Zero();  // likewise, times their mass [m/s^2]
  std::vector<std::array<double, 2>> curve;  // (t, factor), linear between, constant outside; none: 1
};

/// Tets of a body that differ from it: the union of what is given, of centroids at rest, placed.
struct RegionSettings {
  std::vector<int> tag;  // physical tags of the mesh
  std::optional<BoxSelector> box;
  std::optional<SphereSelector> sphere;
  std::optional<PlaneSelector> plane;
  std::optional<double> density;             // [kg/m^3], > 0; none: as it is without the region
  std::optional<MaterialSettings> material;  // likewise
  std::string where;                         // prefix of error messages; empty: made of body and number
};

/// A constant that varies from tet to tet of a body: painted, or through control points by radial basis
/// functions.
struct FieldSettings {
  std::string key;                    // see field_keys()
  std::string file;                   // what is painted; whoever reads it fills in `painted`
  std::vector<double> painted;        // a value for each tet, or for each vertex of the body
  std::vector<Vec3> points;           // control points at rest, placed [m]
  std::vector<double> values;         // at these
  std::string kernel = "biharmonic";  // see radial_kernel_names()
  std::optional<double> radius;       // of kernel gaussian [m], > 0
  bool logarithm = false;             // log(value) is interpolated, so that it stays > 0
  bool scale = false;                 // the values multiply what body and regions give; else they replace it
  std::string where;                  // prefix of error messages; empty: made of body and number
};

/// Forces -C q̇; see Damping.
struct DampingSettings {
  double mass = 0.0;       // Rayleigh's α, of the mass matrix [1/s], >= 0
  double stiffness = 0.0;  // Rayleigh's β, of the tangent stiffness [s], >= 0
  double viscosity = 0.0;  // η, of the strain rate; rigid motion is not damped [Pa s], >= 0
};

/// X_world = translate + rotate(scale · X_file). The rest shape itself is placed.
struct BodySettings {
  std::string name;                 // default: body0, body1, ...
  double density = 1000.0;          // [kg/m^3], > 0
  std::string mass = "consistent";  // or "lumped"
  MaterialSettings material;
  DampingSettings damping;
  double scale = 1.0;             // > 0
  Vec3 rotate = Vec3::Zero();     // Euler angles about the fixed x, then y, then z axis [degrees]
  Vec3 translate = Vec3::Zero();  // [m]
  // At the start: velocity + spin × (X - centre of mass) + those of the file. Pins start with their own.
  Vec3 velocity = Vec3::Zero();  // [m/s]
  Vec3 spin = Vec3::Zero();      // [rad/s]
  std::string velocities;        // file of a velocity for each vertex; whoever reads it fills in BodyInput's
  std::string start = "rest";    // shape of frame 0 but for pinned vertices; see start_names()
  int seed = 0;                  // of "scramble"
  std::vector<PinSettings> pin;
  std::vector<SpringSettings> spring;
  std::vector<LoadSettings> load;
  std::vector<RegionSettings> region;  // later ones win
  std::vector<FieldSettings> field;    // over the regions; later ones win
};

struct TimeSettings {
  double fps = 30.0;  // frame k is at t = k / fps [1/s], > 0
  int frames = 150;   // pictures 0 .. frames-1, >= 1
  int substeps = 1;   // steps a frame, >= 1
  std::string integrator = "backward_euler";
  Vec3 gravity = Vec3(0.0, -9.81, 0.0);  // [m/s^2]
  std::optional<double>
      error_tolerance;  // of a step's estimated error, else it is halved [m], > 0; none: any
};

struct SolverSettings {
  double tolerance = 1e-6;   // Newton stops at |g_free| <= tolerance * |(M g)_free|, in (0, 1)
  int max_iterations = 100;  // Newton iterations a step, >= 1
  int max_halvings = 8;      // how often a step that does not converge is halved, >= 0
  std::string hessian =
      "auto";  // "auto": exact while its Cholesky factorization succeeds, else projected; "projected"
  std::string linear = "auto";  // how linear systems are solved; see SystemSolver
  int blas_threads = 1;         // OpenBLAS threads in CHOLMOD; part of the result's bits, so of the scene
};

}  // namespace lagomorph::sim
