#include "io/case/quoted.h"

#include <gtest/gtest.h>

#include <string>

namespace billet::io::quoted_test {
namespace {

TEST(Unquoted, UndoesEscapesAndLeavesWhatHasNoQuotes) {
  EXPECT_EQ(unquoted(R"("a disk")"), "a disk");
  EXPECT_EQ(unquoted(R"("a \"flat\" disk")"), "a \"flat\" disk");
  EXPECT_EQ(unquoted(R"("C:\\new")"), "C:\\new");
  EXPECT_EQ(unquoted(R"("two\u000alines\tand\nmore")"), "two lines and more");
  EXPECT_EQ(unquoted("0.5"), "0.5");
  for (const std::string text : {"", "\"", "\"open", R"("\")", R"("\u00")"})
    EXPECT_LE(unquoted(text).size(), text.size()) << text;
}

} // namespace
} // namespace billet::io::quoted_test
