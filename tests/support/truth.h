#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "sim/mesh_io.h"
#include "sim/model.h"
#include "tests/support/paths.h"

/// Reference solutions under tests/data/truth, computed independently of this code; see the README there.
namespace lagomorph::sim::truth {

inline std::filesystem::path path(const std::string& name) {
  return lagomorph::tests::source_dir() / "tests" / "data" / "truth" / name;
}

inline nlohmann::json json(const std::string& name) {
  std::ifstream in(path(name));
  if (!in) throw std::runtime_error("cannot read " + path(name).string());
  return nlohmann::json::parse(in);
}

/// Rows of numbers; lines that do not start with a digit or a sign are left out.
inline std::vector<std::vector<double>> csv(const std::string& name) {
  std::ifstream in(path(name));
  if (!in) throw std::runtime_error("cannot read " + path(name).string());
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.find_first_of("0123456789-") != 0) continue;
    std::vector<double> row;
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      row.push_back(std::stod(line.substr(begin, end - begin)));
      begin = end + 1;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Data of a float64 .npy file in C order, whatever its shape.
inline std::vector<double> npy(const std::string& name) {
  std::ifstream in(path(name), std::ios::binary);
  std::vector<char> bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::size_t header =
      10 + static_cast<unsigned char>(bytes.at(8)) + 256u * static_cast<unsigned char>(bytes.at(9));
  std::vector<double> values((bytes.size() - header) / sizeof(double));
  std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(header), bytes.end(),
            reinterpret_cast<char*>(values.data()));
  return values;
}

inline TetMesh mesh(const std::string& name) {
  Remarks remarks;
  return read_tet_mesh(path(name), remarks);
}

inline bool has_model(const std::string& truth_name) {
  return truth_name == "nh_lecture" || truth_name == "snh" || truth_name == "snh_log" ||
         truth_name == "stvk" || truth_name == "corotated";
}

/// The truth's names of the energies to ours.
inline std::string model_name(const std::string& truth_name) {
  if (truth_name == "nh_lecture") return "neo_hookean";
  if (truth_name == "snh") return "stable_neo_hookean";
  if (truth_name == "snh_log") return "stable_neo_hookean_log";
  if (truth_name == "stvk") return "st_venant_kirchhoff";
  if (truth_name == "corotated") return "corotated";
  throw std::runtime_error("no material for " + truth_name);
}

/// The bar, held at X = 0.
inline Model bar(const std::string& truth_name, double young, const Vec3& gravity) {
  BodyInput body{mesh("bar.mesh"), {}};
  body.settings.material.model = model_name(truth_name);
  body.settings.material.young = young;
  body.settings.material.poisson = 0.3;
  body.settings.pin.emplace_back().box = BoxSelector{Vec3(0, -1, -1), Vec3(0, 1, 1)};
  return Model({body}, gravity);
}

}  // namespace lagomorph::sim::truth
