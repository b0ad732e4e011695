#pragma once

#include "render/image_compare/error_map.h"
#include "render/image_compare/flip_filters.h"
#include "render/image_compare/lanes.h"
#include "render/image_compare/linear_pair.h"

namespace lagomorph::render {

/// The LDR-FLIP map of a pair, 0 where they look the same from a distance of so many pixels per degree of
/// visual angle, 1 where they differ most [Andersson et al. 2020, "FLIP: A Difference Evaluator for
/// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2)]. Filters clamp to the edge. The same
/// bits for any number of threads and any instruction set. Throws SettingsError for a bad
/// `pixels_per_degree`.
ErrorMap flip_map(const LinearPair&, double pixels_per_degree = default_pixels_per_degree,
                  InstructionSet = widest_instruction_set());

}  // namespace lagomorph::render
