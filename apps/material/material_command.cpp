#include <charconv>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "apps/cli/print.h"
#include "apps/commands.h"
#include "apps/file_io.h"
#include "apps/material/load_curves.h"
#include "apps/material/load_picture.h"
#include "apps/material/load_text.h"
#include "sim/determinant.h"
#include "sim/materials/table.h"

namespace lagomorph::apps {
namespace {

/// "f00,f01,...,f22", row by row.
sim::Mat3 parse_F(const std::string& text) {
  sim::Mat3 F;
  const char* begin = text.data();
  const char* const end = begin + text.size();
  for (int k = 0; k < 9; ++k) {
    while (begin != end && *begin == ' ') ++begin;
    const auto [stop, error] = std::from_chars(begin, end, F(k / 3, k % 3));
    const bool followed = k < 8 ? stop != end && *stop == ',' : stop == end;
    if (error != std::errc() || !followed || !std::isfinite(F(k / 3, k % 3))) {
      wrong_input(
          fmt::format("--F {}: must be nine finite numbers, row by row, between commas; wrong at number {}",
                      text, k + 1));
    }
    begin = stop + 1;
  }
  return F;
}

template <class Matrix>
std::string row_major(const Matrix& matrix) {
  std::string text;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += fmt::format("{}{:.17g}", text.empty() ? "" : ", ", matrix(i, j));
  return text;
}

/// ψ, P and the Hessian at one F.
std::string at_one_F(const sim::MaterialPoint& material, const Options& options) {
  const sim::Mat3 F = parse_F(*options.F);
  const double psi = material.psi(F);
  const sim::Mat3 P = material.dpsi_dF(F);
  const sim::Mat9 H = material.d2psi_dF2(F);
  if (!std::isfinite(psi) || !P.allFinite() || !H.allFinite()) {
    wrong_input(fmt::format("--F {}: {} has no finite energy and derivatives there, with det F = {:.6g}",
                            *options.F, options.material.model, sim::determinant(F)));
  }
  if (options.json) {
    return fmt::format("{{\"psi\": {:.17g}, \"P\": [{}], \"H\": [{}]}}\n", psi, row_major(P), row_major(H));
  }
  std::string text = fmt::format("psi  {:.17g} J/m^3\n", psi);
  const auto add = [&](const char* name, const auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      text += fmt::format("{:<4}", i == 0 ? name : "");
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) text += fmt::format(" {:>13.6g}", matrix(i, j));
      text += i == 0 ? " Pa\n" : "\n";
    }
  };
  add("P", P);
  add("H", H);
  return text;
}

/// Prints the curves and leaves them as a table and a picture in DIR.
void show_curves(const sim::MaterialPoint& material, const Options& options) {
  if (options.material.fibre) {
    wrong_input("--fibre: stress against stretch is of materials without fibres; give --F too");
  }
  const std::vector<LoadCurve> curves = load_curves(material, closed_form(options.material));
  const std::filesystem::path folder = options.out.value_or("out/material");
  const std::filesystem::path table = folder / (options.material.model + ".csv"),
                              picture = folder / (options.material.model + ".svg");
  make_folder(folder);
  write_file(table, load_csv(curves));
  write_file(picture, load_svg(options.material.model, curves));
  if (options.json) {
    print(load_json(options.material.model, curves));
  } else if (!options.quiet) {
    print(load_text(options.material.model, curves) +
          fmt::format("\n{}\n{}\n", table.string(), picture.string()));
  }
}

}  // namespace

ExitStatus material_command(const Options& given) {
  Options options = given;
  options.material.model = options.inputs.at(0);
  sim::check_material(options.material, "material " + options.material.model);
  const auto material = sim::make_material_point(options.material, "material " + options.material.model);
  if (options.F) {
    print(at_one_F(*material, options));
  } else {
    show_curves(*material, options);
  }
  return ExitStatus::done;
}

}  // namespace lagomorph::apps
