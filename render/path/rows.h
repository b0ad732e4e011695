#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/camera.h"
#include "render/path/lane_math.h"
#include "render/path/medium.h"

/// Rows of numbers, one of each path or surface of a batch, so that a loop over a batch is vector code.
namespace lagomorph::render::path {

/// Paths that are traced in step.
inline constexpr std::size_t batch_size = 512;

/// A cache line longer than n: rows of a power of two would all meet in the same few lines of the cache.
template <class T, std::size_t n = batch_size>
// NOLINTNEXTLINE(bugprone-sizeof-expression): of a row of pointers, the size of a pointer is meant
struct alignas(64) Row : std::array<T, n + 64 / sizeof(T)> {};

template <std::size_t n = batch_size>
struct Row3 {
  Row<float, n> x, y, z;

  F3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, F3 a) {
    x[i] = a.x;
    y[i] = a.y;
    z[i] = a.z;
  }
};

struct RayRows {
  std::size_t count = 0;
  Row3<> origin, direction;
  Row<float> time;  // only of scenes that move
  Row<float> far;   // of shadow rays: nothing is in the way behind it [m]

  Ray operator[](std::size_t i) const { return {vec3(origin[i]), vec3(direction[i]), time[i]}; }
};

/// The rays that go on, and what they bring.
struct PathRows {
  RayRows rays;
  Row3<> throughput;
  Row<float> bsdf_pdf;   // of the ray's direction [1/sr]
  Row<float> sky_pdf;    // of the same by next-event estimation
  Row<float> least_pdf;  // bsdf_pdf's least along the path
  Row<std::uint32_t> lane;
  Row<const Absorption*> inside;  // what the ray is in, where that is told
  Row<std::uint32_t> clear;       // bounces that do not count
  Row<float> compressed;          // of the throughput, by indices of refraction
};

/// Rays to lights, and the light that arrives when nothing is in the way.
struct ShadowRows {
  RayRows rays;
  Row3<> light;
  Row<std::uint32_t> lane;
  Row<std::uint8_t> blocked;

  void push(F3 origin, F3 direction, float far, F3 arriving, std::uint32_t of) {
    const std::size_t i = rays.count++;
    rays.origin.set(i, origin);
    rays.direction.set(i, direction);
    rays.far[i] = far;
    light.set(i, arriving);
    lane[i] = of;
  }
};

}  // namespace lagomorph::render::path
