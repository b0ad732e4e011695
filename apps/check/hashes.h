#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "render/pixels.h"

namespace lagomorph::apps {

/// A golden picture of which only the hashes are kept.
struct PictureHash {
  std::string file;    // sha-256 of the PNG file
  std::string pixels;  // of its size, kind and samples, however they are compressed
};

/// Of what compare_frame would find equal.
std::string pixels_sha256(const render::Pixels&);

/// GOLDEN/hashes.json; empty when there is none. Throws Error(wrong_input) for what is none of ours.
std::map<int, PictureHash> read_hashes(const std::filesystem::path& golden);
/// Writes it; removes it when there is nothing in it.
void write_hashes(const std::filesystem::path& golden, const std::map<int, PictureHash>&);

}  // namespace lagomorph::apps
