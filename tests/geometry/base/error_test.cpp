#include "geometry/base/error.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::error_test {
namespace {

TEST(Error, says_place_message_and_remedy_on_one_line) {
  const Error error(Fault::case_file, "case.toml:3:7", "unknown key 'yuong'",
                    "did you mean 'young'?");
  EXPECT_STREQ(error.what(),
               "case.toml:3:7: unknown key 'yuong' (did you mean 'young'?) [case-refused]");
  EXPECT_EQ(error.fault(), Fault::case_file);
}

TEST(Error, leaves_out_what_is_not_known) {
  EXPECT_STREQ(Error(Fault::geometry, "", "the mesh is empty").what(),
               "the mesh is empty [geometry]");
  EXPECT_STREQ(Error(Fault::geometry, "a.stl", "is empty").what(), "a.stl: is empty [geometry]");
}

TEST(Error, reports_all_complaints_one_a_line) {
  const Error error(Fault::case_file,
                    {{"a:1", "first", "", "key-unknown"}, {"a:2", "second", "repair it"}});
  EXPECT_STREQ(error.what(), "a:1: first [key-unknown]\na:2: second (repair it) [case-refused]");
  EXPECT_EQ(error.complaints().size(), 2U);
}

TEST(Error, is_caught_as_a_standard_exception_and_carries_the_exit_status) {
  try {
    throw Error(Fault::limit, "", "out of memory");
  } catch (const std::exception& caught) {
    EXPECT_EQ(std::string(caught.what()), "out of memory [limit]");
  }
  EXPECT_EQ(static_cast<int>(Fault::usage), 2);
  EXPECT_EQ(static_cast<int>(Fault::limit), 7);
}

} // namespace
} // namespace billet::error_test
