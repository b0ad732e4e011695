#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/check/picture_folder.h"
#include "render/pixels.h"

/// What a failing picture looks like that it does not look like its golden.
namespace lagomorph::apps {

/// By so many pixels, to the right and down.
struct PixelShift {
  int x = 0;
  int y = 0;
  bool operator==(const PixelShift&) const = default;
};
/// "1 pixel to the right", "2 pixels to the left and 1 pixel up"
std::string shift_text(const PixelShift&);

struct Probe {
  std::optional<int> matches;       // the golden's frame that it is much nearer to
  std::optional<PixelShift> shift;  // of the whole picture
  std::string tone;                 // "blue times 0.85", "gamma 1.1"; empty: not a change of tones alone
  std::vector<std::string> hints() const;
};

/// The shift within 3 pixels that leaves at most a quarter of the squared difference, if there is one.
/// Pictures of one kind.
std::optional<PixelShift> find_shift(const render::Pixels& golden, const render::Pixels& fresh);
/// How tones changed, when that alone explains 95 % of the squared difference; otherwise empty.
std::string find_tone(const render::Pixels& golden, const render::Pixels& fresh);
/// The golden's frame up to 2 away whose mean difference is at most a quarter of this one's.
std::optional<int> find_frame(const PictureFolder& goldens, int frame, const render::Pixels& golden,
                              const render::Pixels& fresh);

Probe probe_frame(const PictureFolder& goldens, int frame, const render::Pixels& golden,
                  const render::Pixels& fresh);

}  // namespace lagomorph::apps
