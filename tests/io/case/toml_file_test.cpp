#include "io/case/document.h"
#include "tests/io/case/case_text.h"

#include <gtest/gtest.h>

namespace billet::io::toml_file_test {
namespace {

std::string written(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Complaints complaints("case.toml");
  Node root = parse_document(text, "case.toml");
  apply_overrides(root, overrides, complaints);
  EXPECT_TRUE(complaints.empty());
  return toml_file(root);
}

TEST(TomlFile, says_the_same_as_the_text_that_was_parsed) {
  for (const std::string& text : {std::string(plane_case), std::string(space_case)})
    EXPECT_TRUE(read(written(text)) == read(text));
}

TEST(TomlFile, keeps_overrides) {
  const std::vector<std::string> overrides{"tool.punch.friction.m=0.2",
                                           "title=\"a \\\"new\\\" one\"", "solver={threads=3}",
                                           "output.at=[0.5, 1.0]"};
  EXPECT_TRUE(read(written(plane_case, overrides)) == read(plane_case, overrides));
}

TEST(TomlFile, keeps_the_order_of_the_text_and_adds_at_the_end) {
  EXPECT_EQ(written("z = 1\n[b]\ny = 2\nx = \"s\"\n[[a]]\nn = [1, 2.5]\n[m.one]\nk = true\n",
                    {"b.w=0.1", "c.v=-1"}),
            "z = 1\n\n[b]\ny = 2\nx = \"s\"\nw = 0.1\n\n[[a]]\nn = [1, 2.5]\n\n[m.one]\nk = true\n"
            "\n[c]\nv = -1\n");
}

TEST(TomlFile, quotes_what_has_to_be_quoted) {
  const std::string text = "\"a b\" = \"line\\nbreak \\\\ \\u0007\"\nc = [{ \"d.e\" = {} }, 1]\n";
  const std::string once = written(text);
  EXPECT_EQ(written(once), once);
  const Node root = parse_document(once, "case.toml");
  EXPECT_EQ(*root.as<Table>()->find("a b")->as<std::string>(), "line\nbreak \\ \a");
}

TEST(EraseKey, removes_values_tables_and_items_by_name_or_index) {
  Complaints complaints("case.toml");
  Node root = parse_document(
      "a = { b = 1, c = 2 }\n[[tool]]\nname = \"p\"\n[[tool]]\nname = \"q\"\n", "case.toml");
  for (const char* key : {"a.b", "tool.p", "tool.0"})
    erase_key(root, key, complaints);
  EXPECT_TRUE(complaints.empty());
  EXPECT_EQ(toml_file(root), "tool = []\n\n[a]\nc = 2\n");
}

TEST(EraseKey, complains_where_there_is_nothing) {
  Complaints complaints("case.toml");
  Node root = parse_document("a = { b = 1 }\n", "case.toml");
  for (const char* key : {"a.c", "b", "a.b.c", "", "a..b"})
    erase_key(root, key, complaints);
  try {
    complaints.throw_if_any();
    FAIL();
  } catch (const Error& error) {
    ASSERT_EQ(error.complaints().size(), 5U);
    EXPECT_EQ(error.complaints().front().text(),
              "case.toml: there is no a.c that could be removed [key-unknown]");
  }
}

} // namespace
} // namespace billet::io::toml_file_test
