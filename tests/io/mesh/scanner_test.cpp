#include "geometry/base/error.h"
#include "io/mesh/scanner.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace billet::io::scanner_test {
namespace {

using test::TemporaryFolder;

TEST(Scanner, reads_words_numbers_and_lines_and_knows_the_line) {
  const TemporaryFolder folder;
  Scanner scanner(folder.file("a", "one 2\n\n  -3.5\r\nrest of  it \r\nlast"));
  EXPECT_EQ(scanner.word(), "one");
  EXPECT_EQ(scanner.integer(), 2);
  EXPECT_EQ(scanner.real(), -3.5);
  EXPECT_EQ(scanner.line_number(), 3U);
  EXPECT_EQ(scanner.line(), "");
  EXPECT_EQ(scanner.line(), "rest of  it");
  EXPECT_EQ(scanner.line_number(), 4U);
  EXPECT_EQ(scanner.line(), "last");
  EXPECT_TRUE(scanner.at_end());
  EXPECT_EQ(scanner.word(), "");
}

TEST(Scanner, names_file_and_line_of_what_it_cannot_read) {
  const TemporaryFolder folder;
  const auto path = folder.file("a", "1\nx\n");
  Scanner scanner(path);
  EXPECT_EQ(scanner.integer(), 1);
  try {
    (void)scanner.integer();
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.complaints().front().place, path.string() + ":2");
  }
}

TEST(Scanner, reads_bytes_of_both_orders) {
  const TemporaryFolder folder;
  Scanner scanner(folder.file("a", std::string("\1\0\0\0\0\0\0\2", 8)));
  EXPECT_EQ(scanner.raw<std::int32_t>(false), 1);
  EXPECT_EQ(scanner.raw<std::int32_t>(true), 2);
  EXPECT_THROW((void)scanner.raw<std::int32_t>(false), Error);
}

TEST(Scanner, refuses_counts_that_the_rest_of_the_file_cannot_hold) {
  const TemporaryFolder folder;
  EXPECT_EQ(Scanner(folder.file("a", "2 1 1\n")).count("items", 2), 2U);
  EXPECT_THROW((void)Scanner(folder.file("b", "9 1 1\n")).count("items", 2), Error);
  EXPECT_THROW((void)Scanner(folder.file("c", "-1\n")).count("items", 2), Error);
}

TEST(ParseReal, takes_what_fortran_and_people_write_and_nothing_else) {
  for (const auto& [text, value] : std::initializer_list<std::pair<const char*, double>>{
           {"1", 1.0}, {"+1.5", 1.5}, {"-.5", -0.5}, {"2.", 2.0}, {"1d3", 1e3}, {"1.0D-2", 1e-2}}) {
    double read = 0.0;
    EXPECT_TRUE(parse_real(text, read)) << text;
    EXPECT_EQ(read, value);
  }
  for (const char* text :
       {"", "+", "-", "1x", "nan", "inf", "1e999", "+-1", "0x10", "1 2", "1,5"}) {
    double read = 0.0;
    EXPECT_FALSE(parse_real(text, read)) << text;
  }
}

} // namespace
} // namespace billet::io::scanner_test
