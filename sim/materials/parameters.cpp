#include "sim/materials/parameters.h"

#include <cmath>

#include "sim/error.h"
#include "sim/materials/neo_hookean.h"
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
  const bool by_lame = has_pair(s.mu, s.lambda, "mu", "lambda", where);
  if (by_lame && (s.young || s.poisson))
    throw InputError(where + ": mu and lambda are given beside young or poisson; give one pair");
  if (by_lame) {
    require(*s.mu > 0.0, where, "mu", *s.mu, "> 0 Pa");
    require(*s.lambda + 2.0 / 3.0 * *s.mu > 0.0, where, "lambda", *s.lambda, "> -2/3 mu");
    return {.mu = *s.mu, .lambda = *s.lambda};
  }
  const double young = s.young.value_or(kDefaultYoung), poisson = s.poisson.value_or(kDefaultPoisson);
  require(young > 0.0, where, "young", young, "> 0 Pa");
  require(poisson > -1.0 && poisson < 0.5, where, "poisson", poisson, "in (-1, 0.5)");
  return lame_from_young(young, poisson);
}

NeoHookean NeoHookean::from_settings(const MaterialSettings& s, const std::string& where) {
  if (has_pair(s.C, s.D, "C", "D", where)) {
    if (s.mu || s.lambda || s.young || s.poisson)
      throw InputError(where + ": C and D are given beside other constants; give one pair");
    require(*s.C > 0.0, where, "C", *s.C, "> 0 Pa");
    require(*s.D >= 0.0, where, "D", *s.D, ">= 0 Pa");
    return {.C = *s.C, .D = *s.D};
  }
  const Lame lame = lame_parameters(s, where);
  // Its bulk modulus is lambda itself: a negative one would let the body collapse or grow without bound.
  if (s.lambda) require(lame.lambda >= 0.0, where, "lambda", lame.lambda, ">= 0 Pa for neo_hookean");
  if (s.poisson) require(*s.poisson >= 0.0, where, "poisson", *s.poisson, "in [0, 0.5) for neo_hookean");
  return {.C = 0.5 * lame.mu, .D = 0.5 * lame.lambda};
}

namespace {

Lame lame_without_C_and_D(const MaterialSettings& s, const std::string& where) {
  if (s.C || s.D)
    throw InputError(where + ": C and D belong to neo_hookean; give young and poisson, or mu and lambda");
  return lame_parameters(s, where);
}

}  // namespace

StableNeoHookean StableNeoHookean::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_without_C_and_D(s, where);
  return {.mu = lame.mu, .lambda = lame.lambda};
}

StableNeoHookeanLog StableNeoHookeanLog::from_settings(const MaterialSettings& s, const std::string& where) {
  const Lame lame = lame_without_C_and_D(s, where);
  return {.m = 4.0 / 3.0 * lame.mu, .l = lame.lambda + 5.0 / 6.0 * lame.mu};
}

}  // namespace lagomorph::sim
