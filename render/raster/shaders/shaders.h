#pragma once

/// GLSL in parts, to be put one after the other: `frame` first, then what a pass calls, then the pass.
namespace lagomorph::render::raster::shaders {

extern const char* const frame;         // the Frame block, camera rays, the quad's mean
extern const char* const brdf;          // GGX coat over Lambert, a rectangle's light on it
extern const char* const sky;           // the sky's light on a point
extern const char* const shade;         // all of it together
extern const char* const ground_point;  // where a pixel sees the ground
extern const char* const ground_color;
extern const char* const octahedron;
extern const char* const layers;       // the samples of a pixel, sorted by surface
extern const char* const layer_point;  // the mean of one of those

extern const char* const full_screen_vertex;
extern const char* const layer_vertex;
extern const char* const tiles_vertex;
extern const char* const mesh_vertex;
extern const char* const ground_vertex;
extern const char* const emitter_vertex;

extern const char* const seen_fragment;
extern const char* const still_fragment;
extern const char* const backdrop_fragment;
extern const char* const ground_light_fragment;
extern const char* const surface_fragment;
extern const char* const parts_seen;
extern const char* const plain_vertex;
extern const char* const plain_fragment;
extern const char* const layer_fragment;
extern const char* const ground_cover_fragment;
extern const char* const ground_map_fragment;
extern const char* const composite_fragment;
extern const char* const mesh_depth_fragment;
extern const char* const mesh_number_fragment;
extern const char* const ground_depth_fragment;

extern const char* const data_outputs;
extern const char* const data_fragment;
extern const char* const ground_data_fragment;
extern const char* const alpha_fragment;

}  // namespace lagomorph::render::raster::shaders
