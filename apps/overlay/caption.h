#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/overlay/layout.h"
#include "apps/overlay/overlay.h"
#include "render/color.h"

namespace lagomorph::apps {

/// What a frame's caption may tell. Energies in J.
struct CaptionValues {
  std::string name;  // of the scene
  int frame = 0, frames = 1;
  double time = 0.0;  // [s]
  double kinetic = 0.0, elastic = 0.0, gravitational = 0.0, total = 0.0;
  int iterations = 0;  // of Newton's method, for this frame
  double min_J = 1.0;
};

/// The text of a form in which {name}, {frame}, {frames}, {time}, {kinetic}, {elastic}, {gravitational},
/// {total}, {iterations} and {min_J} stand for values, with formats as of Python's str.format ({frame:04},
/// {time:.2f}). Throws Error(wrong_input) that says what is wrong with the form.
std::string caption_text(const std::string& form, const CaptionValues&);

/// top_left, top, top_right, bottom_left, bottom, bottom_right.
std::vector<std::string> caption_places();

/// A caption's lines and what they stand on.
struct Caption {
  Rectangle plate;
  std::vector<std::string> lines;
  double height = 0.0;  // of capitals [pixels]
};

/// Takes room for a text at a place as above; none where there is no text or no room for a word. Capitals are
/// as tall as the layout's captions, where the lines have room so, else as small as its text. Lines that
/// are too wide are wrapped at spaces, and what has no room in height is cut, with three dots in its place.
/// The plate and the lines' ends are the same for other digits.
std::optional<Caption> place_caption(OverlayLayout&, const std::string& text, const std::string& place);

/// Writes a caption's lines on their plate: in its middle, each where the first begins.
void draw_caption(render::Picture&, const Caption&);

}  // namespace lagomorph::apps
