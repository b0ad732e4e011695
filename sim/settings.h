#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/types.h"

/// What a scene says of the physics, as plain structs with defaults. SI units. Names are those of the scene
/// file.
namespace lagomorph::sim {

/// Give (young, poisson), or (mu, lambda), or for `neo_hookean` (C, D). With none, young = 1e5 Pa and poisson
/// = 0.3.
struct MaterialSettings {
  std::string model = "stable_neo_hookean";  // see material_names()
  std::optional<double> young;               // Young's modulus [Pa], > 0
  std::optional<double> poisson;             // Poisson's ratio, in (-1, 0.5)
  std::optional<double> mu;                  // shear modulus [Pa], > 0
  std::optional<double> lambda;              // Lamé's first parameter [Pa]
  std::optional<double> C;                   // lecture's C = mu/2 [Pa]
  std::optional<double> D;                   // lecture's D = lambda/2 [Pa]
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

/// Vertices held where they are at the start. More than one selector in one pin selects the union.
struct PinSettings {
  std::vector<int> vertices;             // 0-based, in file order, per body
  std::optional<BoxSelector> box;        // of rest positions, after the body is placed
  std::optional<SphereSelector> sphere;  // likewise
  std::optional<PlaneSelector> plane;    // likewise
  std::optional<double> top;             // upper fraction of the rest bounding box along +y, in (0, 1]
  std::optional<double> bottom;          // lower fraction, in (0, 1]
};

/// X_world = translate + rotate(scale · X_file). The rest shape itself is placed.
struct BodySettings {
  std::string name;                 // default: body0, body1, ...
  double density = 1000.0;          // [kg/m^3], > 0
  std::string mass = "consistent";  // or "lumped"
  MaterialSettings material;
  double scale = 1.0;             // > 0
  Vec3 rotate = Vec3::Zero();     // Euler angles about the fixed x, then y, then z axis [degrees]
  Vec3 translate = Vec3::Zero();  // [m]
  Vec3 velocity = Vec3::Zero();   // initial velocity [m/s]; pinned vertices start at rest
  std::vector<PinSettings> pin;
};

struct TimeSettings {
  double fps = 30.0;  // frame k is at t = k / fps [1/s], > 0
  int frames = 150;   // pictures 0 .. frames-1, >= 1
  int substeps = 1;   // steps a frame, >= 1
  std::string integrator = "backward_euler";
  Vec3 gravity = Vec3(0.0, -9.81, 0.0);  // [m/s^2]
};

struct SolverSettings {
  double tolerance = 1e-6;   // Newton stops at |g_free| <= tolerance * |(M g)_free|, in (0, 1)
  int max_iterations = 100;  // Newton iterations a step, >= 1
  int max_halvings = 8;      // how often a step that does not converge is halved, >= 0
  std::string hessian =
      "auto";  // "auto": exact while its Cholesky factorization succeeds, else projected; "projected"
  int blas_threads = 1;  // OpenBLAS threads in CHOLMOD; part of the result's bits, so of the scene
};

}  // namespace lagomorph::sim
