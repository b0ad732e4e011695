#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lagomorph::sim {

/// What a run spends its time with.
enum class Stage {
  // a step,
  energy,    // V(q) and what else is summed to Φ
  gradient,  // ∂V/∂q
  hessian,   // elements' ∂²V/∂q², assembled
  analysis,  // order of elimination, structure of the factor; order of the blocks for conjugate gradients
  factorization,  // CHOLMOD
  solve,          // substitutions, conjugate gradients
  simulation,     // a frame's state, with all of the above
  // a picture,
  surface,    // positions and fields of what is drawn
  draw,       // the renderer, but for
  read_back,  // what it drew from the device to memory
  overlays,   // colours to eight bits, captions, glyphs, lines
  encode,     // PNG, EXR, .npy
  write,      // files and their hashes
  // and the three threads' waiting for each other.
  wait_to_simulate,
  wait_to_draw,
  wait_to_write,
  count
};
inline constexpr std::size_t kStages = static_cast<std::size_t>(Stage::count);
std::string_view to_string(Stage);

/// Seconds and calls of each stage in this process, of all threads.
class Profile {
public:
  void add(Stage stage, std::chrono::nanoseconds time) {
    Entry& entry = entries_[static_cast<std::size_t>(stage)];
    entry.nanoseconds.fetch_add(time.count(), std::memory_order_relaxed);
    entry.calls.fetch_add(1, std::memory_order_relaxed);
  }
  double seconds(Stage stage) const {
    return 1e-9 * static_cast<double>(entries_[static_cast<std::size_t>(stage)].nanoseconds.load());
  }
  std::int64_t calls(Stage stage) const { return entries_[static_cast<std::size_t>(stage)].calls.load(); }

private:
  struct Entry {
    std::atomic<std::int64_t> nanoseconds = 0, calls = 0;
  };
  std::array<Entry, kStages> entries_;
};

/// The process's own. A run is a process, and its stages are far apart: libraries that know nothing of each
/// other, and threads.
Profile& profile();

/// Adds the time that it lives to a stage.
class Timed {
public:
  explicit Timed(Stage stage) : stage_(stage) {}
  ~Timed() { profile().add(stage_, Clock::now() - start_); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

private:
  using Clock = std::chrono::steady_clock;
  Stage stage_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace lagomorph::sim
