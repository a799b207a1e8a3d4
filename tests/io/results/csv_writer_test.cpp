#include "geometry/base/error.h"
#include "io/results/csv_writer.h"
#include "tests/io/full_disk.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace billet::io::csv_writer_test {
namespace {

using test::content_of;
using test::FullDisk;
using test::TemporaryFolder;

const std::vector<std::string> columns{"increment", "time", "punch.force_y"};

TEST(CsvWriter, writes_a_header_and_whole_rows_that_are_there_at_once) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "history.csv";
  CsvWriter table(path, columns);
  EXPECT_EQ(content_of(path), "increment,time,punch.force_y\n");
  table.row(std::array{1.0, 0.25, -1e-7});
  EXPECT_EQ(content_of(path), "increment,time,punch.force_y\n1,0.25,-9.9999999999999995e-08\n");
}

TEST(CsvWriter, reading_a_value_gives_the_same_bits) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  CsvWriter table(path, {"x"});
  for (const double value : {1.0 / 3.0, std::nextafter(1.0, 2.0), 1e300, 5e-324, -0.1}) {
    table.row(std::array{value});
    const std::string content = content_of(path);
    const std::size_t line = content.rfind('\n', content.size() - 2) + 1;
    EXPECT_EQ(std::strtod(content.c_str() + line, nullptr), value);
  }
}

TEST(CsvWriter, names_with_commas_and_quotes_are_quoted) {
  const TemporaryFolder folder;
  const CsvWriter table(folder.path() / "t.csv", {"a,b", "c\"d"});
  EXPECT_EQ(content_of(folder.path() / "t.csv"), "\"a,b\",\"c\"\"d\"\n");
}

TEST(CsvWriter, a_full_disk_is_told_and_leaves_only_whole_rows) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  CsvWriter table(path, columns);
  bool told = false;
  {
    const FullDisk disk(100);
    try {
      for (int i = 0; i < 100; ++i)
        table.row(std::array{1.0, 2.0, 3.0});
    } catch (const Error& error) {
      told = true;
      EXPECT_EQ(error.fault(), Fault::input_output);
      EXPECT_EQ(error.complaints().front().place, path.string());
      EXPECT_NE(error.complaints().front().remedy.find("free some space"), std::string::npos);
    }
  }
  EXPECT_TRUE(told);
  const std::string content = content_of(path);
  EXPECT_TRUE(content.ends_with("1,2,3\n")) << content;
  EXPECT_GT(content.size(), 90U);
  table.row(std::array{4.0, 5.0, 6.0});
  EXPECT_TRUE(content_of(path).ends_with("1,2,3\n4,5,6\n"));
}

TEST(CsvWriter, a_device_without_room_is_told) {
  EXPECT_THROW(CsvWriter("/dev/full", columns), Error);
}

TEST(CsvWriter, places_that_cannot_hold_files_are_refused) {
  const TemporaryFolder folder;
  EXPECT_THROW(CsvWriter(folder.path() / "absent" / "t.csv", columns), Error);
  EXPECT_THROW(CsvWriter(folder.path(), columns), Error);
}

TEST(CsvWriter, a_resumed_table_keeps_the_rows_of_the_checkpoint_and_goes_on) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  {
    CsvWriter table(path, columns);
    for (double i = 1; i < 5; ++i)
      table.row(std::array{i, i, i});
  }
  CsvWriter table = CsvWriter::resume(path, columns, 2);
  table.row(std::array{3.0, 0.5, 0.5});
  EXPECT_EQ(content_of(path), "increment,time,punch.force_y\n1,1,1\n2,2,2\n3,0.5,0.5\n");
  table = CsvWriter::resume(path, columns, 3);
  table.row(std::array{4.0, 0.5, 0.5});
  EXPECT_TRUE(content_of(path).ends_with("3,0.5,0.5\n4,0.5,0.5\n"));
}

TEST(CsvWriter, a_table_that_does_not_fit_the_checkpoint_is_not_resumed) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "t.csv";
  EXPECT_THROW((void)CsvWriter::resume(path, columns, 0), Error);
  { CsvWriter(path, columns).row(std::array{1.0, 1.0, 1.0}); }
  EXPECT_THROW((void)CsvWriter::resume(path, columns, 2), Error);
  EXPECT_THROW((void)CsvWriter::resume(path, {"other"}, 1), Error);
  EXPECT_NO_THROW((void)CsvWriter::resume(path, columns, 1));
}

} // namespace
} // namespace billet::io::csv_writer_test
