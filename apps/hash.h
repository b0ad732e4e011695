#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lagomorph::apps {

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  /// 64 lower-case hexadecimal digits of everything added. Call once.
  std::string hex();

private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// SHA-256 of the bytes, in hexadecimal.
std::string sha256(std::string_view bytes);

/// SHA-256 of a file's contents, in hexadecimal. Throws Error(wrong_input) when it cannot be read.
std::string sha256_file(const std::filesystem::path&);

}  // namespace lagomorph::apps
