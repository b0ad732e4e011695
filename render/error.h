#pragma once

#include <stdexcept>

namespace lagomorph::render {

/// A scene or setting that cannot be drawn (exit status 2). One line: the value and what would be right.
struct SettingsError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The machine failed: no GL context, Embree out of memory (exit status 4). One line.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lagomorph::render
