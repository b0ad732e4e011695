#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace lagomorph::apps {

/// What is told on stderr while a command works: a bar with frames a second and time left on a terminal,
/// plain lines otherwise, nothing when quiet. Safe to use from many threads.
class Progress {
public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One line.
  void note(const std::string& line);
  /// So many frames are to come, each in so many passes over all of them. `stage` says of what, where there
  /// are several one after another: "drawing".
  void begin(int frames, int passes = 1, const std::string& stage = "");
  /// In one of the passes.
  void frame_done();
  /// The bar goes.
  void end();

private:
  using Clock = std::chrono::steady_clock;
  enum class Style { silent, lines, bar };

  void draw_bar(double seconds);
  void clear_bar();
  void print_line(double seconds);

  /// Frames that all passes so far would have made whole.
  int done() const { return steps_done_ / passes_; }

  const Style style_;
  std::mutex mutex_;
  int frames_ = 0, passes_ = 1;
  std::string stage_;   // and a space, or nothing
  int steps_done_ = 0;  // frames in passes
  int told_ = 0;        // done() when the last line was printed
  bool bar_is_there_ = false;
  Clock::time_point begin_, last_;
};

/// "1:04:10", "2:05", "7 s"
std::string duration_text(double seconds);

}  // namespace lagomorph::apps
