#pragma once

#include "render/render_scene.h"

namespace lagomorph::render {

/// The colour by which a material is told from others in the channels of albedo: its base colour, a metal's
/// reflectance; of a dielectric, as much as it has a cloudy inside that one's colour, and over that, as much
/// as it has a clear inside, what that lets through.
Color albedo(const Material&);

/// Part of it that is a dielectric with a clear inside.
float clear_part(const Material&);
/// Reflectance of the dielectric at normal incidence, ((n - 1) / (n + 1))^2 [Fresnel].
float dielectric_f0(const Material&);
/// Its coat's varnish alone, as a material.
Material coat_of(const Material&);

}  // namespace lagomorph::render
