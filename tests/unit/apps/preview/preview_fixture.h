#pragma once

#include <string>
#include <vector>

#include "render/png.h"
#include "render/png_read.h"
#include "tests/unit/apps/pipeline/run_fixture.h"

/// Runs and folders of pictures that are previewed by the program itself.
namespace lagomorph::tests {

/// A picture of one colour.
inline std::string plain_png(int width, int height, int red, int green, int blue) {
  render::Picture picture{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    for (const int value : {red, green, blue}) picture.rgb.push_back(static_cast<std::uint8_t>(value));
  }
  return render::encode_png(picture, 1);
}

class PreviewFixture : public ProgramRun {
protected:
  /// Three numbered pictures of a folder, the brighter the later.
  void add_pictures(const std::string& folder, int first = 1, int last = 3, int width = 48,
                    int height = 32) const {
    for (int i = first; i <= last; ++i)
      dir_.write(std::filesystem::path(folder) / ("shot" + std::to_string(i) + ".png"),
                 plain_png(width, height, 60 * i, 20, 20));
  }
  Ended preview(const std::string& of, const Arguments& more = {}, const ProgramOptions& options = {}) const {
    return run_program(Arguments{"preview", at(of).string()} + more, options);
  }
  /// What --json says, after a preview that is done.
  nlohmann::json json_of(const std::string& of, const Arguments& more = {},
                         const ProgramOptions& options = {}) const {
    const Ended ended = preview(of, more + Arguments{"--json"}, options);
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    return nlohmann::json::parse(ended.out);
  }
  /// One line on stderr, and nothing written.
  std::string refusal(int status, const std::string& of, const Arguments& more = {},
                      const ProgramOptions& options = {}) const {
    const Ended ended = preview(of, more, options);
    EXPECT_EQ(ended.status, status) << ended.err << ended.out;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(at(of) / "preview"));
    return ended.err;
  }
  std::string made(const std::string& of, const std::string& file) const {
    return read_all(at(of) / "preview" / file);
  }
  bool is_made(const std::string& of, const std::string& file) const {
    return std::filesystem::exists(at(of) / "preview" / file);
  }
};

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace lagomorph::tests
