#include "apps/file_io.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "apps/error.h"

namespace lagomorph::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary_suffix = ".tmp";
constexpr std::size_t stream_buffer = std::size_t{1} << 20;  // [bytes]

/// A path that cannot be what it should is wrong input; everything else is the machine's.
[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  const bool wrong = error == ENOTDIR || error == EEXIST || error == EISDIR || error == ENAMETOOLONG ||
                     error == ELOOP || error == EINVAL;
  throw Error(wrong ? ExitStatus::wrong_input : ExitStatus::machine,
              path.string() + ": " + what + ": " + std::strerror(error));
}

class Descriptor {
public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

private:
  const int fd_;
};

int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return -1;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// So that the rename itself outlives a crash of the machine.
void sync_folder_of(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (descriptor.get() >= 0) ::fsync(descriptor.get());
}

bool is_temporary(std::string name) {
  if (name.size() < 2 || name.front() != '.' || !name.ends_with(temporary_suffix)) return false;
  name.resize(name.size() - temporary_suffix.size());
  const std::size_t dot = name.rfind('.');
  return dot > 0 && dot + 1 < name.size() &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(dot) + 1, name.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

void make_folder(const fs::path& folder) {
  if (folder.empty()) return;
  struct stat status;
  if (::stat(folder.c_str(), &status) == 0) {
    if (!S_ISDIR(status.st_mode)) fail(folder, "cannot be a folder", ENOTDIR);
    return;
  }
  if (errno != ENOENT) fail(folder, "cannot be a folder", errno);
  const fs::path clean = folder.has_filename() ? folder : folder.parent_path();
  make_folder(clean.parent_path());
  if (::mkdir(clean.c_str(), 0777) == 0) return;
  const int error = errno;
  if (std::error_code unused; error == EEXIST && fs::is_directory(clean, unused)) return;  // made meanwhile
  fail(folder, "the folder cannot be made", error);
}

bool is_there(const fs::path& path) {
  std::error_code none;
  return fs::exists(path, none);
}

std::string read_file(const fs::path& path) {
  const auto unreadable = [&](int error) {
    return Error(ExitStatus::wrong_input, path.string() + ": cannot be read: " + std::strerror(error));
  };
  const Descriptor file(path, O_RDONLY);
  if (file.get() < 0) throw unreadable(errno);
  std::string bytes;
  struct stat status;
  if (::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode)) {
    bytes.reserve(static_cast<std::size_t>(status.st_size) + 1);
  }
  for (;;) {
    const std::size_t size = bytes.size();
    bytes.resize(std::max(bytes.capacity(), size + 4096));
    const ssize_t got = ::read(file.get(), bytes.data() + size, bytes.size() - size);
    const int error = errno;
    bytes.resize(size + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return bytes;
    if (got < 0 && error != EINTR) throw unreadable(error);
  }
}

FileStream::FileStream(fs::path path) : path_(std::move(path)), temporary_(temporary_name(path_)) {
  fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd_ < 0) fail(path_, "cannot be written", errno);
}

FileStream::~FileStream() {
  if (fd_ < 0) return;
  ::close(fd_);
  ::unlink(temporary_.c_str());
}

void FileStream::write(std::string_view bytes) {
  size_ += bytes.size();
  if (buffer_.size() + bytes.size() <= stream_buffer) {
    buffer_ += bytes;
    return;
  }
  flush();
  if (write_all(fd_, bytes) != 0) give_up();
}

void FileStream::flush() {
  if (write_all(fd_, buffer_) != 0) give_up();
  buffer_.clear();
}

void FileStream::finish(Durable durable) {
  flush();
  if (durable == Durable::yes && ::fsync(fd_) != 0) give_up();
  const int closed = ::close(fd_);  // some file systems report a failed write only here
  fd_ = -1;
  if (closed != 0) give_up();
  rename_into_place(temporary_, path_);
  if (durable == Durable::yes) sync_folder_of(path_);
}

void FileStream::give_up() {
  const int error = errno;
  ::unlink(temporary_.c_str());
  fail(path_, "cannot be written", error);
}

void write_file(const fs::path& path, std::string_view bytes, Durable durable) {
  FileStream file(path);
  file.write(bytes);
  file.finish(durable);
}

bool write_file_if_changed(const fs::path& path, std::string_view bytes, Durable durable) {
  std::error_code error;
  if (fs::is_regular_file(path, error) && fs::file_size(path, error) == bytes.size() && !error &&
      read_file(path) == bytes) {
    return false;
  }
  write_file(path, bytes, durable);
  return true;
}

void link_file(const fs::path& from, const fs::path& to) {
  const fs::path temporary = temporary_name(to);
  ::unlink(temporary.c_str());
  if (::link(from.c_str(), temporary.c_str()) == 0) {
    rename_into_place(temporary, to);
    ::unlink(temporary.c_str());  // stays when both were the same file already
  } else {
    write_file(to, read_file(from));
  }
}

fs::path temporary_name(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.{}{}", path.filename().string(), ::getpid(), temporary_suffix);
}

void rename_into_place(const fs::path& temporary, const fs::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  ::unlink(temporary.c_str());
  fail(path, "cannot be written", error);
}

void remove_file(const fs::path& path) {
  if (::unlink(path.c_str()) == 0 || errno == ENOENT) return;
  throw Error(ExitStatus::machine, path.string() + ": cannot be removed: " + std::strerror(errno));
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (is_temporary(entry.path().filename().string())) remove_file(entry.path());
  }
}

}  // namespace lagomorph::apps
