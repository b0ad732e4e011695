#include "apps/progress/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "apps/one_line.h"

namespace lagomorph::apps {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr double bar_interval = 0.1;    // [s]
constexpr double line_interval = 10.0;  // [s]; and at every tenth of the frames

bool is_capable_terminal() {
  const char* term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

int terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

/// In one call, so that lines of several processes do not mix.
void put(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

std::string rate_text(int done, int frames, double seconds) {
  const double rate = seconds > 0.0 ? done / seconds : 0.0;
  if (done >= frames || rate <= 0.0) return fmt::format("{:.3g} frames/s", rate);
  return fmt::format("{:.3g} frames/s, {} left", rate, duration_text((frames - done) / rate));
}

}  // namespace

std::string duration_text(double seconds) {
  const long s = std::lround(std::max(0.0, seconds));
  if (seconds < 9.95) return fmt::format("{:.1f} s", std::max(0.0, seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

Progress::Progress(bool quiet)
    : style_(quiet ? Style::silent : (is_capable_terminal() ? Style::bar : Style::lines)) {}

Progress::~Progress() { clear_bar(); }

void Progress::note(const std::string& line) {
  if (style_ == Style::silent) return;
  const std::lock_guard lock(mutex_);
  clear_bar();
  put(one_line(line) + "\n");
}

void Progress::begin(int frames, int passes, const std::string& stage) {
  const std::lock_guard lock(mutex_);
  frames_ = frames;
  passes_ = passes;
  stage_ = stage.empty() ? "" : stage + " ";
  steps_done_ = told_ = 0;
  begin_ = last_ = Clock::now();
  if (style_ == Style::bar && frames > 0) draw_bar(0.0);
}

void Progress::frame_done() {
  if (style_ == Style::silent) return;
  const std::lock_guard lock(mutex_);
  if (++steps_done_ % passes_ != 0) return;
  const Clock::time_point now = Clock::now();
  const double seconds = Seconds(now - begin_).count();
  const double silence = Seconds(now - last_).count();
  if (style_ == Style::bar) {
    if (silence < bar_interval && done() < frames_) return;
    draw_bar(seconds);
  } else {
    const bool tenth = 10L * done() / frames_ > 10L * told_ / frames_;
    if (!tenth && silence < line_interval) return;
    print_line(seconds);
  }
  last_ = now;
}

void Progress::end() {
  const std::lock_guard lock(mutex_);
  clear_bar();
}

void Progress::draw_bar(double seconds) {
  const std::string text = fmt::format(" {}{:>{}}/{}  {}", stage_, done(), std::to_string(frames_).size(),
                                       frames_, rate_text(done(), frames_, seconds));
  const int room = std::clamp(terminal_width() - static_cast<int>(text.size()) - 3, 0, 40);
  const int filled = frames_ > 0 ? room * done() / frames_ : 0;
  const std::string bar = room > 4 ? fmt::format("[{}{}]", std::string(static_cast<std::size_t>(filled), '#'),
                                                 std::string(static_cast<std::size_t>(room - filled), ' '))
                                   : "";
  put("\r" + bar + text + "\x1b[K");
  bar_is_there_ = true;
}

void Progress::clear_bar() {
  if (!bar_is_there_) return;
  put("\r\x1b[K");
  bar_is_there_ = false;
}

void Progress::print_line(double seconds) {
  put(fmt::format("{}frame {} of {}, {}\n", stage_, done(), frames_, rate_text(done(), frames_, seconds)));
  told_ = done();
}

}  // namespace lagomorph::apps
