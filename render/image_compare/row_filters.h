#pragma once

#include <cstddef>

#include "render/image_compare/flip_filters.h"
#include "render/image_compare/lanes.h"

/// One-dimensional filters along rows (step 1) or columns (step: a row's stride), a block of neighbouring
/// pixels at a time. Each output is the same sum in the same order wherever its block begins.
namespace lagomorph::render {

/// sum over k of w[k] (p[-k step] + p[k step]).
template <std::size_t n>
LAGOMORPH_INLINE void even(const float* p, std::ptrdiff_t step, const EvenFilter& filter, float* out) {
  const float* w = filter.data();
  const auto radius = static_cast<std::ptrdiff_t>(filter.size()) - 1;
  Lanes<n> sum_0 = w[0] * load<n>(p);
  Lanes<n> sum_1 = w[0] * load<n>(p + n);
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    const float* before = p - k * step;
    const float* after = p + k * step;
    sum_0 += w[k] * (load<n>(before) + load<n>(after));
    sum_1 += w[k] * (load<n>(before + n) + load<n>(after + n));
  }
  store<n>(out, sum_0);
  store<n>(out + n, sum_1);
}

/// First and second derivative likewise, exactly zero where p is constant.
template <std::size_t n>
LAGOMORPH_INLINE void derivatives(const float* p, std::ptrdiff_t step, const FlipFilters& filters,
                                  float* first, float* second) {
  const float* w1 = filters.first.data();
  const float* w2 = filters.second.data();
  const auto radius = static_cast<std::ptrdiff_t>(filters.first.size()) - 1;
  const Lanes<n> here_0 = load<n>(p);
  const Lanes<n> here_1 = load<n>(p + n);
  Lanes<n> first_0{};
  Lanes<n> first_1{};
  Lanes<n> second_0{};
  Lanes<n> second_1{};
  for (std::ptrdiff_t k = 1; k <= radius; ++k) {
    const Lanes<n> before_0 = here_0 - load<n>(p - k * step);
    const Lanes<n> before_1 = here_1 - load<n>(p - k * step + n);
    const Lanes<n> after_0 = load<n>(p + k * step) - here_0;
    const Lanes<n> after_1 = load<n>(p + k * step + n) - here_1;
    first_0 += w1[k] * (after_0 + before_0);
    first_1 += w1[k] * (after_1 + before_1);
    second_0 += w2[k] * (after_0 - before_0);
    second_1 += w2[k] * (after_1 - before_1);
  }
  store<n>(first, first_0);
  store<n>(first + n, first_1);
  store<n>(second, second_0);
  store<n>(second + n, second_1);
}

}  // namespace lagomorph::render
