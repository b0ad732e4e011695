#include "apps/file_io.h"

#include <csignal>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "apps/error.h"
#include "tests/support/program.h"
#include "tests/support/temporary_directory.h"

namespace lagomorph::apps {
namespace file_io_test {

namespace fs = std::filesystem;
using tests::read_all;
using tests::TemporaryDirectory;

/// Status and message of the Error that the action must throw.
template <class Action>
std::pair<ExitStatus, std::string> error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return {error.status, error.what()};
  }
  return {ExitStatus::done, "no error"};
}

int files_in(const fs::path& folder) {
  int n = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++n;
  return n;
}

TEST(FileIo, WritesWholeFilesAndLeavesNothingElse) {
  const TemporaryDirectory dir;
  const std::string bytes("a\0b\n", 4);
  write_file(dir.path() / "a", bytes);
  EXPECT_EQ(read_all(dir.path() / "a"), bytes);
  write_file(dir.path() / "a", "second", Durable::yes);
  EXPECT_EQ(read_all(dir.path() / "a"), "second");
  EXPECT_EQ(read_file(dir.path() / "a"), "second");
  EXPECT_EQ(files_in(dir.path()), 1);
}

TEST(FileIo, WritesIntoTheCurrentFolder) {
  const TemporaryDirectory dir;
  const fs::path before = fs::current_path();
  fs::current_path(dir.path());
  write_file("plain", "x", Durable::yes);
  make_folder("a/b/");
  fs::current_path(before);
  EXPECT_EQ(read_all(dir.path() / "plain"), "x");
  EXPECT_TRUE(fs::is_directory(dir.path() / "a" / "b"));
}

TEST(FileIo, ReadsLargeFilesWhole) {
  const TemporaryDirectory dir;
  std::string bytes(1 << 20, 'x');
  bytes[12345] = 'y';
  write_file(dir.path() / "large", bytes);
  EXPECT_TRUE(read_file(dir.path() / "large") == bytes);
}

TEST(FileIo, LeavesAFileWithTheSameBytesAlone) {
  const TemporaryDirectory dir;
  const fs::path file = dir.path() / "a";
  EXPECT_TRUE(write_file_if_changed(file, "one"));
  struct stat before, after;
  ASSERT_EQ(::stat(file.c_str(), &before), 0);
  EXPECT_FALSE(write_file_if_changed(file, "one"));
  ASSERT_EQ(::stat(file.c_str(), &after), 0);
  EXPECT_EQ(before.st_ino, after.st_ino);
  EXPECT_TRUE(write_file_if_changed(file, "two"));
  EXPECT_EQ(read_all(file), "two");
}

TEST(FileIo, AFileInTheWayIsWrongInput) {
  const TemporaryDirectory dir;
  const fs::path file = dir.write("file", "x");
  EXPECT_EQ(error_of([&] { make_folder(file); }),
            std::pair(ExitStatus::wrong_input, file.string() + ": cannot be a folder: Not a directory"));
  EXPECT_EQ(error_of([&] { make_folder(file / "sub"); }).first, ExitStatus::wrong_input);
  EXPECT_EQ(error_of([&] { make_folder(dir.path() / std::string(300, 'a')); }).first,
            ExitStatus::wrong_input);
  fs::create_directory(dir.path() / "folder");
  EXPECT_EQ(error_of([&] { write_file(dir.path() / "folder", "x"); }).first, ExitStatus::wrong_input);
  EXPECT_EQ(files_in(dir.path()), 2);
}

TEST(FileIo, AFolderThatTheMachineRefusesIsTheMachines) {
  EXPECT_EQ(error_of([] { make_folder("/proc/lagomorph"); }).first, ExitStatus::machine);
  EXPECT_EQ(error_of([] { write_file("/proc/lagomorph", "x"); }).first, ExitStatus::machine);
}

TEST(FileIo, AFileThatCannotBeReadIsWrongInput) {
  const TemporaryDirectory dir;
  const fs::path missing = dir.path() / "missing";
  EXPECT_EQ(
      error_of([&] { read_file(missing); }),
      std::pair(ExitStatus::wrong_input, missing.string() + ": cannot be read: No such file or directory"));
  EXPECT_EQ(error_of([&] { read_file(dir.path()); }).first, ExitStatus::wrong_input);
}

TEST(FileIo, AWriteThatFailsLeavesTheOldFileAndNoOther) {
  const TemporaryDirectory dir;
  const fs::path file = dir.write("a", "old");
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto error = error_of([&] { write_file(file, std::string(5000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(error, std::pair(ExitStatus::machine, file.string() + ": cannot be written: File too large"));
  EXPECT_EQ(read_all(file), "old");
  EXPECT_EQ(files_in(dir.path()), 1);
}

TEST(FileIo, AStreamStandsInItsPlaceOnlyOnceFinished) {
  const TemporaryDirectory dir;
  const fs::path file = dir.write("a", "old");
  const std::string large(3 << 20, 'x');
  {
    FileStream stream(file);
    stream.write("small ");
    stream.write(large);
    stream.write(" end");
    EXPECT_EQ(stream.size(), large.size() + 10);
    EXPECT_EQ(read_all(file), "old");
    EXPECT_EQ(fs::file_size(temporary_name(file)), large.size() + 6);  // the rest is in memory
    stream.finish();
    EXPECT_TRUE(read_all(file) == "small " + large + " end");
  }
  EXPECT_EQ(files_in(dir.path()), 1);
  dir.write("a", "old");
  { FileStream(file).write(large); }  // not finished
  EXPECT_EQ(read_all(file), "old");
  EXPECT_EQ(files_in(dir.path()), 1);
}

TEST(FileIo, AStreamThatFailsLeavesTheOldFileAndNoOther) {
  const TemporaryDirectory dir;
  const fs::path file = dir.write("a", "old");
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{3 << 20, before.rlim_max};
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto error = error_of([&] {
    FileStream stream(file);
    for (int i = 0; i < 100; ++i) stream.write(std::string(100000, 'x'));
    stream.finish();
  });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(error, std::pair(ExitStatus::machine, file.string() + ": cannot be written: File too large"));
  EXPECT_EQ(read_all(file), "old");
  EXPECT_EQ(files_in(dir.path()), 1);
}

TEST(FileIo, LinksReplaceAndKeepTheOriginal) {
  const TemporaryDirectory dir;
  const fs::path from = dir.write("from", "bytes"), to = dir.write("to", "other");
  link_file(from, to);
  link_file(from, to);  // once more, where both are the same file already
  EXPECT_EQ(read_all(to), "bytes");
  write_file(to, "new");
  EXPECT_EQ(read_all(from), "bytes");
  EXPECT_EQ(files_in(dir.path()), 2);
}

TEST(FileIo, LinksAcrossFileSystemsAreCopies) {
  const TemporaryDirectory dir;
  const fs::path from = "/proc/self/mountinfo";
  link_file(from, dir.path() / "to");
  EXPECT_FALSE(read_all(dir.path() / "to").empty());
}

TEST(FileIo, RemovesLeftoversAndNothingElse) {
  const TemporaryDirectory dir;
  for (const char* name : {".frame_0001.png.4711.tmp", ".bunny.mp4.1.tmp"}) dir.write(name, "half");
  for (const char* name : {"frame_0001.png", ".tmp", ".a.tmp", "a.12.tmp", ".a.12x.tmp", ".12.tmp"})
    dir.write(name, "");
  remove_leftovers(dir.path());
  EXPECT_EQ(files_in(dir.path()), 6);
  EXPECT_FALSE(fs::exists(dir.path() / ".frame_0001.png.4711.tmp"));
  remove_leftovers(dir.path() / "missing");
  dir.write(temporary_name("x").string(), "half");
  remove_leftovers(dir.path());
  EXPECT_EQ(files_in(dir.path()), 6);
}

TEST(FileIo, RemovingWhatIsNotThereIsNoError) {
  const TemporaryDirectory dir;
  remove_file(dir.path() / "missing");
  EXPECT_EQ(error_of([&] { remove_file(dir.path()); }).first, ExitStatus::machine);
}

}  // namespace file_io_test
}  // namespace lagomorph::apps
