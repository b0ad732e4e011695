#include "apps/scene/body_keys.h"

namespace lagomorph::apps {

void visit_optics(render::Material& m, KeyVisitor& v) {
  v.key({.name = "transmission",
         .bounds = between(0, 1),
         .meaning = "part of the dielectric that is clear inside: 1 glass or jelly, refracting by ior and "
                    "roughness"},
        &m.transmission);
  v.key({.name = "absorption_color",
         .bounds = between(0, 1),
         .meaning = "linear RGB that the clear inside lets through over absorption_distance"},
        &m.absorption_color);
  v.key({.name = "absorption_distance",
         .unit = "m",
         .bounds = between(1e-6, 1e6),
         .meaning = "a way d lets absorption_color^(d / absorption_distance) through"},
        &m.absorption_distance);
  v.key({.name = "subsurface",
         .bounds = between(0, 1),
         .meaning = "part of the diffuse base that is cloudy inside: 1 skin, wax or milk, by random walk"},
        &m.subsurface);
  v.key({.name = "subsurface_color",
         .bounds = between(0, 1),
         .meaning = "linear RGB: diffuse albedo of a thick piece of the cloudy inside"},
        &m.subsurface_color);
  v.key({.name = "subsurface_radius",
         .unit = "m",
         .bounds = between(1e-6, 1e6),
         .meaning = "mean free path in the cloudy inside, of red, green and blue",
         .single = true},
        &m.subsurface_radius);
  v.key({.name = "coat", .bounds = between(0, 1), .meaning = "a clear varnish of index 1.5 over all"},
        &m.coat);
  v.key({.name = "coat_roughness", .bounds = between(0, 1), .meaning = "of the varnish, perceptual"},
        &m.coat_roughness);
  v.key({.name = "sheen", .bounds = between(0, 1), .meaning = "fuzz of cloth, bright along the silhouette"},
        &m.sheen);
  v.key({.name = "sheen_tint", .bounds = between(0, 1), .meaning = "linear RGB of the fuzz"}, &m.sheen_tint);
  v.key({.name = "sheen_roughness",
         .bounds = between(0, 1),
         .meaning = "how far from the silhouette the fuzz is seen"},
        &m.sheen_roughness);
  v.key({.name = "opacity",
         .bounds = between(0, 1),
         .meaning =
             "part of the surface that is there: light goes straight through the rest, in shadows as well"},
        &m.opacity);
}

}  // namespace lagomorph::apps
