#include "apps/check/hashes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/error.h"
#include "apps/file_io.h"
#include "apps/hash.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path file_of(const fs::path& golden) { return golden / "hashes.json"; }

}  // namespace

std::string pixels_sha256(const render::Pixels& pixels) {
  Sha256 hash;
  hash.add(fmt::format("{}x{} {} channels {} bits\n", pixels.width, pixels.height, pixels.channels,
                       pixels.bit_depth()));
  std::visit(
      [&](const auto& samples) {
        hash.add({reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof samples[0]});
      },
      pixels.samples);
  return hash.hex();
}

std::map<int, PictureHash> read_hashes(const fs::path& golden) {
  std::map<int, PictureHash> hashes;
  std::error_code none;
  const fs::path file = file_of(golden);
  if (!fs::exists(file, none)) return hashes;
  try {
    const Json json = Json::parse(read_file(file));
    for (const Json& frame : json.at("frames")) {
      hashes[frame.at("frame").get<int>()] = {frame.at("file_sha256").get<std::string>(),
                                              frame.at("pixels_sha256").get<std::string>()};
    }
  } catch (const Json::exception& e) {
    wrong_input(fmt::format("{}: is no list of golden hashes ({})", file.string(), e.what()));
  }
  return hashes;
}

void write_hashes(const fs::path& golden, const std::map<int, PictureHash>& hashes) {
  if (hashes.empty()) {
    remove_file(file_of(golden));
    return;
  }
  Json frames = Json::array();
  for (const auto& [frame, hash] : hashes) {
    frames.push_back({{"frame", frame}, {"file_sha256", hash.file}, {"pixels_sha256", hash.pixels}});
  }
  write_file_if_changed(file_of(golden), Json{{"version", 1}, {"frames", frames}}.dump(1) + "\n",
                        Durable::yes);
}

}  // namespace lagomorph::apps
