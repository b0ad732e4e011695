#pragma once

#include <string>
#include <vector>

#include "apps/material/load_curves.h"

/// Stress against stretch as text for people, tables and programs.
namespace lagomorph::apps {

/// A row each tenth of stretch, with the largest difference from the closed form.
std::string load_text(const std::string& model, const std::vector<LoadCurve>&);
/// Columns loading, stretch, free_stretch, stress, closed_form; 17 digits. Empty where there is no
/// equilibrium.
std::string load_csv(const std::vector<LoadCurve>&);
/// {"model", "curves": {NAME: {"stretch", "free_stretch", "stress", "closed_form"}}}; null where there is
/// none.
std::string load_json(const std::string& model, const std::vector<LoadCurve>&);

}  // namespace lagomorph::apps
