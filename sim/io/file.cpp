#include "sim/io/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "sim/error.h"

namespace lagomorph::sim::io {

File read_file(const std::filesystem::path& path) {
  File file{path.string(), {}};
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(file.path + ": is a directory, not a mesh file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.path.c_str(), "rb"),
                                                               &std::fclose);
  if (!stream) throw InputError(file.path + ": cannot be read: " + std::strerror(errno));
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  // One byte more than the size lets the first read see the end; a pipe tells no size and grows.
  file.bytes.resize(error ? 65536 : static_cast<std::size_t>(size) + 1);
  std::size_t filled = 0;
  for (;;) {
    filled += std::fread(file.bytes.data() + filled, 1, file.bytes.size() - filled, stream.get());
    if (filled < file.bytes.size()) break;
    file.bytes.resize(2 * filled);
  }
  if (std::ferror(stream.get())) throw InputError(file.path + ": cannot be read: " + std::strerror(errno));
  file.bytes.resize(filled);
  return file;
}

}  // namespace lagomorph::sim::io
