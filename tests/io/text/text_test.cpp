#include "io/text/text.h"

#include <gtest/gtest.h>

#include <string_view>

namespace billet::io::text_test {
namespace {

using namespace std::string_view_literals;

TEST(Text, LosesBlanksAtItsEndsOnly) {
  EXPECT_EQ(trimmed(""sv), "");
  EXPECT_EQ(trimmed(" \t\r\n\v\f"sv), "");
  EXPECT_EQ(trimmed("solid"sv), "solid");
  EXPECT_EQ(trimmed("\t25 mm\r\n"sv), "25 mm");
  EXPECT_EQ(trimmed("  a\tb "sv), "a\tb");
}

TEST(Text, KeepsBytesThatAreNoBlanks) {
  EXPECT_EQ(trimmed("\0a\0"sv), "\0a\0"sv);
  EXPECT_EQ(trimmed("\u00a0\u00b0 "sv), "\u00a0\u00b0");
}

} // namespace
} // namespace billet::io::text_test
