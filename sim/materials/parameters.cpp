#include "sim/materials/parameters.h"

#include <cmath>

#include "sim/error.h"
#include "sim/materials/arap.h"
#include "sim/materials/corotated.h"
#include "sim/materials/fibre.h"
#include "sim/materials/fixed_corotated.h"
#include "sim/materials/linear_elasticity.h"
#include "sim/materials/mooney_rivlin.h"
#include "sim/materials/neo_hookean.h"
#include "sim/materials/neo_hookean_log.h"
#include "sim/materials/presets.h"
#include "sim/materials/st_venant_kirchhoff.h"
#include "sim/materials/stable_neo_hookean.h"
#include "sim/materials/stable_neo_hookean_log.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

constexpr double kDefaultYoung = 1e5;  // [Pa]
constexpr double kDefaultPoisson = 0.3;

void require(bool ok, const std::string& where, const char* name, double value, const char* valid) {
  if (ok && std::isfinite(value)) return;
  throw InputError(where + ": " + name + " = " + short_number(value) + " must be " + valid);
}

/// Both of a pair, or an error that names the missing one.
bool has_pair(const std::optional<double>& a, const std::optional<double>& b, const char* a_name,
              const char* b_name, const std::string& where) {
  if (a.has_value() != b.has_value())
    throw InputError(where + ": " + (a ? a_name : b_name) + " is given without " + (a ? b_name : a_name) +
                     "; give both");
  return a.has_value();
}

}  // namespace

Lame lame_from_young(double young, double poisson) {
  return {.mu = young / (2.0 * (1.0 + poisson)),
          .lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))};
}

Lame lame_parameters(const MaterialSettings& s, const std::string& where) {
  const Preset* const preset = find_preset(s.preset, where);
  const bool by_lame = has_pair(s.mu, s.lambda, "mu", "lambda", where);
  if (by_lame && (s.young || s.poisson))
    throw InputError(where + ": mu and lambda are given beside young or poisson; give one pair");
  if (by_lame) {
    require(*s.mu > 0.0, where, "mu", *s.mu, "> 0 Pa");
    require(*s.lambda + 2.0 / 3.0 * *s.mu > 0.0, where, "lambda", *s.lambda, "> -2/3 mu");
    return {.mu = *s.mu, .lambda = *s.lambda};
  }
  const double young = s.young.value_or(preset ? preset->young : kDefaultYoung);
  const double poisson = s.poisson.value_or(preset ? preset->poisson : kDefaultPoisson);
  require(young > 0.0, where, "young", young, "> 0 Pa");
  require(poisson > -1.0 && poisson < 0.5, where, "poisson", poisson, "in (-1, 0.5)");
  return lame_from_young(young, poisson);
}

namespace {

/// That no model's own constants are given but those of the model itself.
void refuse_constants_of_others(const MaterialSettings& s, const std::string& model,
                                const std::string& where) {
  if ((s.C || s.D) && model != NeoHookean::kName)
    throw InputError(where + ": C and D belong to neo_hookean; give young and poisson, or mu and lambda");
  if ((s.C10 || s.C01 || s.bulk) && model != MooneyRivlin::kName)
    throw InputError(where +
                     ": C10, C01 and bulk belong to mooney_rivlin; give young and poisson, or mu and lambda");
}

Lame lame_of(const MaterialSettings& s, const std::string& model, const std::string& where) {
  refuse_constants_of_others(s, model, where);
  return lame_parameters(s, where);
}

/// A negative lambda would let the volume term of these models reward collapse or growth without bound.
Lame lame_with_lambda_not_negative(const MaterialSettings& s, const std::string& model,
                                   const std::string& where) {
  const Lame lame = lame_of(s, model, where);
  if (s.lambda) require(lame.lambda >= 0.0, where, "lambda", lame.lambda, (">= 0 Pa for " + model).c_str());
  if (s.poisson)
    require(*s.poisson >= 0.0, where, "poisson", *s.poisson, ("in [0, 0.5) for " + model).c_str());
  return lame;
}

}  // namespace

NeoHookean NeoHookean::from_settings(const MaterialSettings& s, const std::string& where) {
  if (s.moduli != "lecture" && s.moduli != "matched")
    throw InputError(where + ": unknown moduli '" + s.moduli + "'; valid ones are lecture, matched");
  if (has_pair(s.C, s.D, "C", "D", where)) {
    if (s.mu || s.lambda || s.young || s.poisson)
      throw InputError(where + ": C and D are given beside other constants; give one pair");
    refuse_constants_of_others(s, kName, where);
    require(*s.C > 0.0, where, "C", *s.C, "> 0 Pa");
    require(*s.D >= 0.0, where, "D", *s.D, ">= 0 Pa");
    return {.C = *s.C, .D = *s.D};
  }
  if (s.moduli == "matched") {
    const Lame lame = lame_of(s, kName, where);
    return {.C = 0.5 * lame.mu, .D = 0.5 * lame.lambda + lame.mu / 3.0};
  }
  const Lame lame = lame_with_lambda_not_negative(s, kName, where);
  return {.C = 0.5 * lame.mu, .D = 0.5 * lame.lambda};
}

NeoHookeanLog NeoHookeanLog::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_with_lambda_not_negative(s, kName, where);
  return {.mu = lame.mu, .lambda = lame.lambda};
}

StableNeoHookean StableNeoHookean::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_of(s, kName, where);
  return {.mu = lame.mu, .lambda = lame.lambda};
}

StableNeoHookeanLog StableNeoHookeanLog::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_of(s, kName, where);
  return {.m = 4.0 / 3.0 * lame.mu, .l = lame.lambda + 5.0 / 6.0 * lame.mu};
}

MooneyRivlin MooneyRivlin::from_settings(const MaterialSettings& s, const std::string& where) {
  if (!s.C10 && !s.C01 && !s.bulk) {
    const Lame lame = lame_of(s, kName, where);
    return {.C10 = 0.4 * lame.mu, .C01 = 0.1 * lame.mu, .bulk = lame.lambda + 2.0 / 3.0 * lame.mu};
  }
  if (!s.C10 || !s.C01 || !s.bulk)
    throw InputError(where + ": of C10, C01 and bulk some are missing; give all three");
  if (s.mu || s.lambda || s.young || s.poisson)
    throw InputError(where + ": C10, C01 and bulk are given beside other constants; give one set");
  refuse_constants_of_others(s, kName, where);
  require(*s.C10 >= 0.0, where, "C10", *s.C10, ">= 0 Pa");
  require(*s.C01 >= 0.0, where, "C01", *s.C01, ">= 0 Pa");
  require(*s.C10 + *s.C01 > 0.0, where, "C10 + C01", *s.C10 + *s.C01, "> 0 Pa");
  require(*s.bulk >= 0.0, where, "bulk", *s.bulk, ">= 0 Pa");
  return {.C10 = *s.C10, .C01 = *s.C01, .bulk = *s.bulk};
}

StVenantKirchhoff StVenantKirchhoff::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_of(s, kName, where);
  return {.mu = lame.mu, .lambda = lame.lambda};
}

Corotated Corotated::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_of(s, kName, where);
  return {.mu = lame.mu, .lambda = lame.lambda};
}

FixedCorotated FixedCorotated::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_with_lambda_not_negative(s, kName, where);
  return {.mu = lame.mu, .lambda = lame.lambda};
}

Arap Arap::from_settings(const MaterialSettings& s, const std::string& where) {
  return {.mu = lame_of(s, kName, where).mu};
}

LinearElasticity LinearElasticity::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_of(s, kName, where);
  return {.mu = lame.mu, .lambda = lame.lambda};
}

Fibre Fibre::from_settings(const MaterialSettings& s, const std::string& where) {
  if (!s.fibre) throw InputError(where + ": has no fibre");
  const FibreSettings& f = *s.fibre;
  const double length = f.direction.stableNorm();
  require(length > 0.0, where, "fibre.direction's length", length, "> 0");
  require(f.stiffness > 0.0, where, "fibre.stiffness", f.stiffness, "> 0 Pa");
  require(f.exponent >= 0.0, where, "fibre.exponent", f.exponent, ">= 0");
  return {
      .a = f.direction / length, .k1 = 0.25 * f.stiffness, .k2 = f.exponent, .compression = f.compression};
}

}  // namespace lagomorph::sim
