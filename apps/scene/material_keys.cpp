#include "apps/scene/body_keys.h"
#include "sim/materials/presets.h"
#include "sim/materials/table.h"
#include "sim/radial_basis.h"
#include "sim/tissue.h"

namespace lagomorph::apps {
namespace {

constexpr Part simulation = Part::simulation;
constexpr const char* pascal = "Pa";

std::vector<std::string> moduli_choices() { return {"lecture", "matched"}; }

void visit_fibre(sim::FibreSettings& f, KeyVisitor& v) {
  v.key({.name = "direction",
         .part = simulation,
         .meaning = "of the rest shape as it is placed, of any length but 0",
         .required = true},
        &f.direction);
  v.key({.name = "stiffness",
         .unit = pascal,
         .bounds = above(0),
         .part = simulation,
         .meaning = "what the fibres add to the modulus along themselves at rest",
         .required = true},
        &f.stiffness);
  v.key({.name = "exponent",
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "k2 of Holzapfel, Gasser and Ogden 2000: stiffening with the stretch; 0 quadratic"},
        &f.exponent);
  v.key(
      {.name = "compression", .part = simulation, .meaning = "fibres push too; false: slack ones do nothing"},
      &f.compression);
}

}  // namespace

void visit_material(sim::MaterialSettings& m, KeyVisitor& v) {
  v.key({.name = "model",
         .part = simulation,
         .meaning = "energy density; neo_hookean is the lecture's, stable_neo_hookean Smith 2018 without and "
                    "stable_neo_hookean_log with the logarithm",
         .choices = sim::material_names},
        &m.model);
  v.key({.name = "preset",
         .part = simulation,
         .meaning = "young and poisson of a substance, where no other constants are given",
         .choices = sim::material_preset_names},
        &m.preset);
  v.key({.name = "young",
         .unit = pascal,
         .bounds = above(0),
         .part = simulation,
         .meaning = "Young's modulus",
         .default_note = "the preset's, or 1e5, with no other modulus"},
        &m.young);
  v.key({.name = "poisson",
         .bounds = inside(-1, 0.5),
         .part = simulation,
         .meaning = "Poisson's ratio; of the lecture's neo_hookean, neo_hookean_log and fixed_corotated >= 0",
         .default_note = "the preset's, or 0.3, with no other modulus"},
        &m.poisson);
  v.key({.name = "mu",
         .unit = pascal,
         .bounds = above(0),
         .part = simulation,
         .meaning = "shear modulus; with lambda, instead of young and poisson"},
        &m.mu);
  v.key({.name = "lambda",
         .unit = pascal,
         .part = simulation,
         .meaning = "Lamé's first parameter, > -2/3 mu, or >= 0 where poisson is; with mu"},
        &m.lambda);
  v.key({.name = "moduli",
         .part = simulation,
         .meaning =
             "of neo_hookean: the lecture's D = lambda/2, or D = (lambda + 2mu/3)/2, which matches young "
             "and poisson",
         .choices = moduli_choices},
        &m.moduli);
  v.key({.name = "C",
         .unit = pascal,
         .bounds = above(0),
         .part = simulation,
         .meaning = "the lecture's C = mu/2; with D, of neo_hookean, instead of young and poisson"},
        &m.C);
  v.key({.name = "D",
         .unit = pascal,
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "the lecture's D; with C, of neo_hookean"},
        &m.D);
  v.key({.name = "C10",
         .unit = pascal,
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "of mooney_rivlin, with C01 and bulk, instead of young and poisson"},
        &m.C10);
  v.key({.name = "C01", .unit = pascal, .bounds = at_least(0), .part = simulation, .meaning = "likewise"},
        &m.C01);
  v.key({.name = "bulk",
         .unit = pascal,
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "bulk modulus of mooney_rivlin, with C10 and C01"},
        &m.bulk);
  v.key(
      {.name = "data",
       .part = simulation,
       .meaning = "of stress_strain: [[strain, stress], ...] of uniaxial loading, nominal, Pa; young, where "
                  "it is given, scales the stress to that modulus at rest"},
      &m.data);
  v.optional({.name = "fibre", .meaning = "fibres in it, beside the model", .is_inline = true}, m.fibre,
             visit_fibre);
}

void visit_damping(sim::DampingSettings& d, KeyVisitor& v) {
  v.key({.name = "mass",
         .unit = "1/s",
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "Rayleigh's alpha, of the mass matrix; damps rigid motion too"},
        &d.mass);
  v.key({.name = "stiffness",
         .unit = "s",
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "Rayleigh's beta, of the tangent stiffness"},
        &d.stiffness);
  v.key({.name = "viscosity",
         .unit = "Pa s",
         .bounds = at_least(0),
         .part = simulation,
         .meaning = "of the rate of strain; rigid motion is not damped"},
        &d.viscosity);
}

void visit_region(sim::RegionSettings& r, KeyVisitor& v) {
  v.key({.name = "tag",
         .part = simulation,
         .meaning = "physical tags of the mesh, one or an array",
         .single = true},
        &r.tag);
  v.key({.name = "box",
         .unit = "m",
         .part = simulation,
         .meaning = "[[x, y, z], [x, y, z]]: centroids at rest from the least to the greatest corner"},
        &r.box);
  v.key({.name = "density",
         .unit = "kg/m^3",
         .bounds = above(0),
         .part = simulation,
         .meaning = "mass density at rest; without it that of the region below, or the body's"},
        &r.density);
  visit_sphere_and_plane(r.sphere, r.plane, v);
  v.optional({.name = "material",
              .meaning = "what the region is made of; what it leaves open is the body's",
              .is_inline = true},
             r.material, visit_material);
}

void visit_field(sim::FieldSettings& f, KeyVisitor& v) {
  v.key({.name = "key",
         .part = simulation,
         .meaning = "the constant that varies",
         .choices = sim::field_keys,
         .required = true},
        &f.key);
  v.key({.name = "file",
         .part = simulation,
         .meaning =
             "painted: .npy of float64, a value a tet, or a vertex and then averaged over a tet's corners",
         .file = true},
        &f.file);
  v.key({.name = "points",
         .unit = "m",
         .part = simulation,
         .meaning = "instead of a file: [[x, y, z], ...], control points in the body at rest, placed"},
        &f.points);
  v.key({.name = "values", .part = simulation, .meaning = "at the points, exactly; smooth between"},
        &f.values);
  v.key({.name = "kernel",
         .part = simulation,
         .meaning = "radial basis function: biharmonic r, triharmonic r^3 with a linear "
                    "polynomial, gaussian exp(-(r/radius)^2)",
         .choices = sim::radial_kernel_names},
        &f.kernel);
  v.key({.name = "radius", .unit = "m", .bounds = above(0), .part = simulation, .meaning = "of gaussian"},
        &f.radius);
  v.key({.name = "logarithm",
         .part = simulation,
         .meaning = "the logarithm is interpolated between the points, so that values stay > 0"},
        &f.logarithm);
  v.key({.name = "scale",
         .part = simulation,
         .meaning = "the values multiply what body and regions give; false: they replace it"},
        &f.scale);
}

}  // namespace lagomorph::apps
