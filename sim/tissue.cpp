#include "sim/tissue.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "sim/error.h"
#include "sim/radial_basis.h"
#include "sim/text.h"

namespace lagomorph::sim {

namespace {

/// What a field may be of, and the values that are valid whatever the model.
struct FieldKey {
  const char* name;
  std::optional<double> MaterialSettings::*constant;  // nullptr: the density
  bool (*valid)(double);
  const char* range;
};

bool is_above_zero(double x) { return x > 0.0; }
bool is_not_negative(double x) { return x >= 0.0; }

const std::vector<FieldKey>& painted_fields() {
  static const std::vector<FieldKey> rows = {
      {"young", &MaterialSettings::young, is_above_zero, "> 0 Pa"},
      {"poisson", &MaterialSettings::poisson, [](double x) { return x > -1.0 && x < 0.5; }, "in (-1, 0.5)"},
      {"mu", &MaterialSettings::mu, is_above_zero, "> 0 Pa"},
      {"lambda", &MaterialSettings::lambda, [](double) { return true; }, "finite"},
      {"C", &MaterialSettings::C, is_above_zero, "> 0 Pa"},
      {"D", &MaterialSettings::D, is_not_negative, ">= 0 Pa"},
      {"density", nullptr, is_above_zero, "> 0 kg/m^3"}};
  return rows;
}

const FieldKey* find_key(const std::string& name) {
  for (const FieldKey& row : painted_fields())
    if (row.name == name) return &row;
  return nullptr;
}

std::string numbers(const std::vector<int>& values) {
  std::string text;
  for (const int value : values) text += (text.empty() ? "" : ", ") + std::to_string(value);
  return text;
}

std::vector<Vec3> centroids_of(const TetMesh& body) {
  std::vector<Vec3> centroids;
  centroids.reserve(body.tets.size());
  for (const Tet& tet : body.tets) {
    Vec3 sum = Vec3::Zero();
    for (const int v : tet) sum += Vec3(body.X.row(v));
    centroids.push_back(0.25 * sum);
  }
  return centroids;
}

/// Tets of a body by their centroids and tags.
class TetSelection {
public:
  TetSelection(const TetMesh& body, const std::vector<Vec3>& centroids, const std::string& where)
      : body_(body),
        centroids_(centroids),
        where_(where),
        min_(body.X.colwise().minCoeff()),
        max_(body.X.colwise().maxCoeff()),
        slack_(1e-12 * std::max(body.X.cwiseAbs().maxCoeff(), (max_ - min_).norm())),
        taken_(body.tets.size(), 0) {}

  std::vector<char> of(const RegionSettings& region) {
    if (region.tag.empty() && !region.box && !region.sphere && !region.plane)
      throw InputError(where_ + ": selects nothing; give tag, box, sphere or plane");
    for (const int tag : region.tag) take_tag(tag);
    if (region.box) take_box(*region.box);
    if (region.sphere) take_sphere(*region.sphere);
    if (region.plane) take_plane(*region.plane);
    return std::move(taken_);
  }

private:
  void take_tag(int tag) {
    if (take([&](std::size_t j) { return body_.tags[j] == tag; })) return;
    const std::set<int> tags(body_.tags.begin(), body_.tags.end());
    refuse("tag " + std::to_string(tag), "the mesh has " + numbers({tags.begin(), tags.end()}));
  }
  void take_box(const BoxSelector& box) {
    if (!(box.min.array() <= box.max.array()).all())  // also catches NaN
      throw InputError(where_ + ": box from " + short_vector(box.min) + " to " + short_vector(box.max) +
                       " is empty; give the smaller corner first");
    take_points("box " + short_vector(box.min) + " to " + short_vector(box.max), [&](const Vec3& x) {
      return ((x - box.min).array() >= -slack_).all() && ((box.max - x).array() >= -slack_).all();
    });
  }
  void take_sphere(const SphereSelector& sphere) {
    if (!(sphere.radius >= 0.0 && std::isfinite(sphere.radius) && sphere.center.allFinite()))
      throw InputError(where_ + ": sphere with centre " + short_vector(sphere.center) + " and radius " +
                       short_number(sphere.radius) + " is none; the radius must be >= 0 and all be finite");
    take_points("sphere around " + short_vector(sphere.center) + " of radius " + short_number(sphere.radius),
                [&](const Vec3& x) { return (x - sphere.center).norm() <= sphere.radius + slack_; });
  }
  void take_plane(const PlaneSelector& plane) {
    const double length = plane.normal.norm();
    if (!(length > 0.0 && std::isfinite(length) && plane.point.allFinite()))
      throw InputError(where_ + ": plane through " + short_vector(plane.point) + " with normal " +
                       short_vector(plane.normal) +
                       " is none; the normal must not be zero and all be finite");
    take_points("plane through " + short_vector(plane.point) + " with normal " + short_vector(plane.normal),
                [&](const Vec3& x) { return (x - plane.point).dot(plane.normal) >= -slack_ * length; });
  }

  template <class Inside>
  void take_points(const std::string& selector, Inside&& inside) {
    if (take([&](std::size_t j) { return inside(centroids_[j]); })) return;
    refuse(selector, "the placed body spans " + short_vector(min_) + " to " + short_vector(max_));
  }
  template <class Inside>
  bool take(Inside&& inside) {
    bool any = false;
    for (std::size_t j = 0; j < taken_.size(); ++j) {
      if (!inside(j)) continue;
      taken_[j] = 1;
      any = true;
    }
    return any;
  }
  [[noreturn]] void refuse(const std::string& selector, const std::string& there) const {
    throw InputError(where_ + ": " + selector + " selects none of the centroids of " +
                     counted(static_cast<long long>(taken_.size()), "tet") + "; " + there);
  }

  const TetMesh& body_;
  const std::vector<Vec3>& centroids_;
  const std::string& where_;
  Vec3 min_, max_;
  double slack_;  // a centroid on the border counts, though placing the body has rounded it [m]
  std::vector<char> taken_;
};

void check_value(const FieldKey& key, double value, const std::string& where) {
  if (std::isfinite(value) && key.valid(value)) return;
  throw InputError(where + ": " + key.name + " = " + short_number(value) + " must be " + key.range);
}

/// A value for each tet of what a file paints on tets or vertices.
std::vector<double> painted_values(const TetMesh& body, const FieldSettings& field, const FieldKey& key,
                                   const std::string& where) {
  const std::vector<double>& painted = field.painted;
  const bool by_tet = painted.size() == body.tets.size();
  if (!by_tet && painted.size() != static_cast<std::size_t>(body.vertex_count()))
    throw InputError(where + ": has " + counted(static_cast<long long>(painted.size()), "value") + "; " +
                     std::to_string(body.tet_count()) + ", one a tet, or " +
                     std::to_string(body.vertex_count()) + ", one a vertex, would be right");
  for (std::size_t i = 0; i < painted.size(); ++i) {
    const std::string at = where + (by_tet ? ": tet " : ": vertex ");
    if (!field.scale) check_value(key, painted[i], at + std::to_string(i));
    if (!std::isfinite(painted[i]))
      throw InputError(at + std::to_string(i) + ": factor " + short_number(painted[i]) + " must be finite");
  }
  if (by_tet) return painted;
  std::vector<double> values;
  values.reserve(body.tets.size());
  for (const Tet& tet : body.tets) {
    double sum = 0.0;
    for (const int v : tet) sum += painted[static_cast<std::size_t>(v)];
    values.push_back(0.25 * sum);
  }
  return values;
}

/// A value for each tet of what control points give at its centroid.
std::vector<double> interpolated_values(const std::vector<Vec3>& centroids, const FieldSettings& field,
                                        const std::string& where) {
  std::vector<double> values = field.values;
  if (field.logarithm) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(values[i] > 0.0))
        throw InputError(where + ": value " + std::to_string(i) + " = " + short_number(values[i]) +
                         " must be > 0 for its logarithm");
      values[i] = std::log(values[i]);
    }
  }
  const RadialBasis field_at(field.points, values, field.kernel, field.radius, where);
  std::vector<double> result;
  result.reserve(centroids.size());
  for (const Vec3& x : centroids) result.push_back(field.logarithm ? std::exp(field_at(x)) : field_at(x));
  return result;
}

/// The tissue while it is being made: by tet.
struct TetTissue {
  std::vector<double> density;
  std::vector<MaterialSettings> materials;  // of regions, then of tets where a field changes them
  std::vector<int> material;                // of each tet, among these
  std::vector<std::string> where;           // of each material
  bool by_tet = false;                      // each tet has its own material, of its number
};

void apply_region(const RegionSettings& region, const std::vector<char>& inside, const std::string& where,
                  TetTissue& tissue) {
  if (!region.density && !region.material)
    throw InputError(where + ": changes nothing; give density or material");
  if (region.density) check_value(*find_key("density"), *region.density, where);
  const int material = static_cast<int>(tissue.materials.size());
  if (region.material) {
    tissue.materials.push_back(*region.material);
    tissue.where.push_back(where + ": material");
  }
  for (std::size_t j = 0; j < inside.size(); ++j) {
    if (!inside[j]) continue;
    if (region.density) tissue.density[j] = *region.density;
    if (region.material) tissue.material[j] = material;
  }
}

/// Gives every tet its own material, so that a constant of it can be its own.
void part_by_tet(TetTissue& tissue) {
  if (std::exchange(tissue.by_tet, true)) return;
  std::vector<MaterialSettings> materials;
  std::vector<std::string> where;
  for (std::size_t j = 0; j < tissue.material.size(); ++j) {
    const auto old = static_cast<std::size_t>(tissue.material[j]);
    materials.push_back(tissue.materials[old]);
    where.push_back(tissue.where[old] + ": tet " + std::to_string(j));
    tissue.material[j] = static_cast<int>(j);
  }
  tissue.materials = std::move(materials);
  tissue.where = std::move(where);
}

void apply_field(const TetMesh& body, const std::vector<Vec3>& centroids, const FieldSettings& field,
                 const std::string& place, TetTissue& tissue) {
  const FieldKey* const key = find_key(field.key);
  if (key == nullptr) {
    std::string names;
    for (const FieldKey& row : painted_fields()) names += (names.empty() ? "" : ", ") + std::string(row.name);
    throw InputError(place + ": unknown key '" + field.key + "'; valid ones are " + names);
  }
  const bool is_painted = !field.file.empty() || !field.painted.empty();
  if (is_painted == (!field.points.empty() || !field.values.empty()))
    throw InputError(place + ": give " + (is_painted ? "either " : "") + "a file, or points and values");
  const std::string where = field.file.empty() ? place : place + ": " + field.file;
  const std::vector<double> values =
      is_painted ? painted_values(body, field, *key, where) : interpolated_values(centroids, field, where);
  if (key->constant != nullptr) part_by_tet(tissue);
  for (std::size_t j = 0; j < values.size(); ++j) {
    const std::string at = where + ": tet " + std::to_string(j);
    double value = values[j];
    if (field.scale) {
      const std::optional<double> base =
          key->constant == nullptr ? std::optional(tissue.density[j]) : tissue.materials[j].*key->constant;
      if (!base) throw InputError(at + ": its material has no " + key->name + " to scale");
      value *= *base;
    }
    check_value(*key, value, at);
    if (key->constant == nullptr) {
      tissue.density[j] = value;
    } else {
      tissue.materials[j].*key->constant = value;
      tissue.where[j] = at;
    }
  }
}

std::string place_of(const std::string& given, const std::string& where, const char* what, std::size_t i) {
  return given.empty() ? where + ": " + what + " " + std::to_string(i) : given;
}

}  // namespace

std::vector<std::string> field_keys() {
  std::vector<std::string> names;
  for (const FieldKey& row : painted_fields()) names.emplace_back(row.name);
  return names;
}

std::optional<double> constant_of(const MaterialSettings& material, const std::string& key) {
  const FieldKey* const row = find_key(key);
  return row == nullptr || row->constant == nullptr ? std::nullopt : material.*row->constant;
}

Tissue make_tissue(const TetMesh& body, const BodySettings& settings, const std::string& where) {
  const Range all{0, body.tet_count()};
  if (settings.region.empty() && settings.field.empty())
    return {{{all, settings.material, where + ": material"}}, {}};
  const std::vector<Vec3> centroids = centroids_of(body);
  TetTissue tissue{std::vector<double>(body.tets.size(), settings.density),
                   {settings.material},
                   std::vector<int>(body.tets.size(), 0),
                   {where + ": material"},
                   false};
  for (std::size_t i = 0; i < settings.region.size(); ++i) {
    const RegionSettings& region = settings.region[i];
    const std::string place = place_of(region.where, where, "region", i);
    apply_region(region, TetSelection(body, centroids, place).of(region), place, tissue);
  }
  for (std::size_t i = 0; i < settings.field.size(); ++i)
    apply_field(body, centroids, settings.field[i], place_of(settings.field[i].where, where, "field", i),
                tissue);
  Tissue result{{}, std::move(tissue.density)};
  for (int j = 0; j < all.end;) {
    const int material = tissue.material[static_cast<std::size_t>(j)], begin = j;
    while (j < all.end && tissue.material[static_cast<std::size_t>(j)] == material) ++j;
    result.parts.push_back({{begin, j},
                            tissue.materials[static_cast<std::size_t>(material)],
                            tissue.where[static_cast<std::size_t>(material)]});
  }
  return result;
}

}  // namespace lagomorph::sim
