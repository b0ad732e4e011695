#pragma once

#include "apps/scene/keys.h"

/// Keys of a body: what it is made of, what holds and drives it, and how it looks.
namespace lagomorph::apps {

void visit_body(BodyDesc&, KeyVisitor&);
/// Of the principled material: what the floor's has, too, and the rest.
void visit_look(render::Material&, KeyVisitor&);
void visit_optics(render::Material&, KeyVisitor&);
void visit_shown_field(ShownField&, KeyVisitor&);
std::vector<std::string> field_choices();
std::vector<std::string> colormap_choices();
void visit_material(sim::MaterialSettings&, KeyVisitor&);
void visit_damping(sim::DampingSettings&, KeyVisitor&);
void visit_region(sim::RegionSettings&, KeyVisitor&);
void visit_field(sim::FieldSettings&, KeyVisitor&);

void visit_sphere_and_plane(std::optional<sim::SphereSelector>&, std::optional<sim::PlaneSelector>&,
                            KeyVisitor&);
void visit_pin(sim::PinSettings&, KeyVisitor&);
void visit_spring(sim::SpringSettings&, KeyVisitor&);
void visit_load(sim::LoadSettings&, KeyVisitor&);

}  // namespace lagomorph::apps
