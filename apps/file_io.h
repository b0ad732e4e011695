#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

/// Files are written whole or not at all: beside their place, under a name that tells what they are, then
/// renamed.
namespace lagomorph::apps {

/// Makes a folder and those above it. Throws Error(wrong_input) when the path cannot be a folder (a file is
/// in its way), Error(machine) when the machine refuses (read-only, full, no permission).
void make_folder(const std::filesystem::path&);

/// False too where it cannot be told.
bool is_there(const std::filesystem::path&);

/// The whole file. Throws Error(wrong_input) when it cannot be read.
std::string read_file(const std::filesystem::path&);

/// Survives a crash of the machine, not only of the program. Only for files that nothing checks afterwards:
/// frames are known by their hash and made again.
enum class Durable { no, yes };

/// Writes the file beside its place and renames it into it. Throws as make_folder does; no temporary file is
/// left.
void write_file(const std::filesystem::path&, std::string_view bytes, Durable = Durable::no);
/// The same, when the file is not there with these bytes already. Returns whether it was written.
bool write_file_if_changed(const std::filesystem::path&, std::string_view bytes, Durable = Durable::no);

/// A file written piece by piece, held in memory a megabyte at a time. It stands in its place only once it is
/// finished; one that is not leaves what was there and no temporary file.
class FileStream {
public:
  /// Throws as write_file does.
  explicit FileStream(std::filesystem::path);
  ~FileStream();
  FileStream(const FileStream&) = delete;
  FileStream& operator=(const FileStream&) = delete;

  void write(std::string_view bytes);
  /// Bytes written so far.
  std::uint64_t size() const { return size_; }
  /// Renames the file into its place.
  void finish(Durable = Durable::no);

private:
  void flush();
  [[noreturn]] void give_up();

  std::filesystem::path path_, temporary_;
  int fd_ = -1;
  std::string buffer_;
  std::uint64_t size_ = 0;
};

/// Another name for the same file, a copy where the file system has no hard links. Replaces what is there.
void link_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// The temporary name beside a file's place that this process writes to: `.frame_0000.png.4711.tmp`.
std::filesystem::path temporary_name(const std::filesystem::path&);
/// Renames a finished temporary file into its place.
void rename_into_place(const std::filesystem::path& temporary, const std::filesystem::path&);
/// Removes a file when it is there. Throws Error(machine) when it stays.
void remove_file(const std::filesystem::path&);
/// Removes the temporary files of earlier processes in a folder; none when there is no such folder.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace lagomorph::apps
