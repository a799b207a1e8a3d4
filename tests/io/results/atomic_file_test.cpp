#include "geometry/base/error.h"
#include "io/results/atomic_file.h"
#include "tests/io/full_disk.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <iterator>

namespace billet::io::atomic_file_test {
namespace {

using test::content_of;
using test::FullDisk;
using test::TemporaryFolder;

std::size_t n_files(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// The complaint when a text cannot be written to a path.
Complaint complaint(const std::filesystem::path& path, const std::string& text) {
  try {
    write_file(path, text);
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::input_output);
    return error.complaints().front();
  }
  ADD_FAILURE() << "written: " << path;
  return {};
}

TEST(AtomicFile, writes_and_replaces_whole_files_and_leaves_nothing_else) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  write_file(path, "first");
  EXPECT_EQ(content_of(path), "first");
  write_file(path, "second", Durable::yes);
  EXPECT_EQ(content_of(path), "second");
  write_file(path, "");
  EXPECT_EQ(content_of(path), "");
  EXPECT_EQ(n_files(folder.path()), 1U);
}

TEST(AtomicFile, a_full_disk_leaves_the_earlier_file_and_no_temporary_one) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.txt", "earlier");
  Complaint told;
  {
    const FullDisk disk(4096);
    told = complaint(path, std::string(100000, 'x'));
  }
  EXPECT_EQ(told.place, path.string());
  EXPECT_NE(told.message.find("File too large"), std::string::npos) << told.message;
  EXPECT_NE(told.remedy.find("free some space"), std::string::npos);
  EXPECT_EQ(content_of(path), "earlier");
  EXPECT_EQ(n_files(folder.path()), 1U);
}

TEST(AtomicFile, places_that_cannot_hold_files_are_refused_with_the_reason) {
  const TemporaryFolder folder;
  const auto file = folder.file("a.txt", "earlier");
  EXPECT_NE(complaint(file / "b.txt", "x").message.find("Not a directory"), std::string::npos);
  EXPECT_NE(complaint(folder.path() / "absent" / "b.txt", "x").message.find("No such file"),
            std::string::npos);
  EXPECT_NE(complaint(folder.path(), "x").message.find("folder"), std::string::npos);
  EXPECT_NE(complaint("/dev/full", "x").message.find("device"), std::string::npos);
  EXPECT_FALSE(complaint("/proc/billet.txt", "x").message.empty());
}

TEST(AtomicFile, files_and_folders_are_synchronized_and_those_that_are_gone_are_left_out) {
  const TemporaryFolder folder;
  synchronize(folder.file("a.txt", "x"));
  synchronize(folder.path());
  synchronize(folder.path() / "");
  synchronize(folder.path() / "absent");
  synchronize("/dev/null"); // knows no such thing
  EXPECT_THROW(synchronize(folder.path() / "a.txt" / "b"), Error);
}

TEST(AtomicFile, folders_are_made_with_those_above_them) {
  const TemporaryFolder folder;
  make_folder(folder.path() / "a" / "b");
  make_folder(folder.path() / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "a" / "b"));
  make_folder(folder.path() / "c" / "d" / "", Durable::yes);
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "c" / "d"));
  const auto file = folder.file("a.txt", "");
  EXPECT_THROW(make_folder(file), Error);
  EXPECT_THROW(make_folder(file / "b", Durable::yes), Error);
}

} // namespace
} // namespace billet::io::atomic_file_test
