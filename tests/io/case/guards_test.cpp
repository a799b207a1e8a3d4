#include "tests/io/case/case_text.h"

#include <gtest/gtest.h>

#include <random>

namespace billet::io::guards_test {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i)
    result += text;
  return result;
}

TEST(Guards, refuse_keys_of_many_parts) {
  for (const std::string& text :
       {repeated("a.", 30000) + "a = 1", "\n[" + repeated("a.", 30000) + "a]",
        "x = { b = \"\"\"a\"\"\"\", " + repeated("a.", 30000) + "a = 1 }",
        repeated("\"a\" . ", 30000) + "a = 1", repeated("a.", 33) + "a = 1"}) {
    const std::vector<Complaint> complaints = complaints_of(text);
    ASSERT_EQ(complaints.size(), 1U);
    EXPECT_NE(complaints[0].message.find("a key of more than"), std::string::npos);
  }
  EXPECT_EQ(complaints_of("\n\n" + repeated("a.", 30000) + "a = 1")[0].place, "case.toml:3");
}

TEST(Guards, refuse_deep_nesting) {
  for (const std::string& open : {std::string("["), std::string("{a="), std::string("[{a.b.c=")}) {
    const std::vector<Complaint> complaints = complaints_of("a = " + repeated(open, 100000));
    ASSERT_EQ(complaints.size(), 1U);
    EXPECT_NE(complaints[0].message.find("nested"), std::string::npos);
  }
}

TEST(Guards, leave_dots_and_brackets_in_strings_and_comments_alone) {
  const std::string many = repeated(".[{", 1000);
  const Case content = read(replaced(plane_case, "title = \"upsetting\"",
                                     "title = \"" + many + "\\\"" + many + "\" # " + many));
  EXPECT_EQ(content.title, many + "\"" + many);
  EXPECT_EQ(read(replaced(plane_case, "\"upsetting\"", "'''" + many + "\n'x''''")).title,
            many + "\n'x'");
}

TEST(Guards, take_long_tables_of_numbers_on_one_line) {
  std::string rows = "[0.0, 0.0]";
  for (int i = 1; i < 2000; ++i)
    rows += ", [" + std::to_string(i) + ".0, 0.5]";
  const Case content = read(replaced(plane_case, "[[0, 0], [1, \"10 MPa\"]]", "[" + rows + "]"));
  EXPECT_EQ(std::get<PressureLoad>(content.loads[0].kind).pressure.points().size(), 2000U);
}

TEST(Guards, refuse_numbers_that_are_not_finite) {
  for (const std::string number : {"nan", "inf", "-inf", "+nan", "\"1e308 GPa\""}) {
    const auto complaints =
        complaints_of(replaced(plane_case, "young = 210000", "young = " + number));
    ASSERT_EQ(complaints.size(), 1U) << number;
    EXPECT_NE(complaints[0].message.find("finite"), std::string::npos) << complaints[0].message;
  }
  EXPECT_FALSE(complaints_of(replaced(plane_case, "210000", "1e999")).empty());
  EXPECT_FALSE(complaints_of(replaced(plane_case, "x = 0", "x = inf")).empty());
}

TEST(Guards, take_letters_beyond_ascii_in_quotes_and_comments) {
  std::string text =
      replaced(plane_case, "[material.spring]", "[material.\"st\u00e4hl\"] # \u00fc");
  text = replaced(text, "\"upsetting\"", "\"\"\"a\\\n \u00e9\u2028\u2007\U0001F600\"\"\"");
  const Case content = read(text);
  EXPECT_TRUE(content.materials.contains("st\u00e4hl"));
  EXPECT_EQ(content.title, "a\u00e9\u2028\u2007\U0001F600");
  for (const std::string word : {"\u00e9 = 1", "a = \u00e9", "a =\u00a0 1"})
    EXPECT_NE(complaints_of("\n" + word)[0].message.find("beyond ASCII"), std::string::npos)
        << word;
}

TEST(Guards, refuse_huge_files) {
  EXPECT_NE(complaints_of(std::string(17U << 20U, '\n'))[0].message.find("16 MiB"),
            std::string::npos);
}

TEST(Guards, report_no_more_than_a_hundred_errors) {
  std::string text = plane_case;
  for (int i = 0; i < 1000; ++i)
    text += "unknown_" + std::to_string(i) + " = 1\n";
  const auto complaints = complaints_of(text);
  ASSERT_EQ(complaints.size(), 101U);
  EXPECT_EQ(complaints.back().message, "and 900 more");
}

/// Reads a text that may be anything; only an Error may come out.
bool survives(const std::string& text) {
  try {
    const Case content = read(text);
    return read(resolved_toml(content)) == content;
  } catch (const Error& error) {
    return error.fault() == Fault::case_file && !error.complaints().empty();
  }
}

std::string mutated(std::string text, std::mt19937& random) {
  static const std::string spice = "[]{}\"'=.,#\n\\-+e0919xyz\xC3\xFF";
  const auto below = [&](std::size_t n) { return random() % n; };
  for (std::size_t k = 1 + below(4); k > 0; --k) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
    case 0:
      text[at] = static_cast<char>(random() & 0xFFU);
      break;
    case 1:
      text[at] = spice[below(spice.size())];
      break;
    case 2:
      text.insert(at, 1, spice[below(spice.size())]);
      break;
    case 3:
      text.erase(at, 1 + below(6));
      break;
    default:
      text.insert(at, text.substr(below(text.size()), below(30)));
      break;
    }
  }
  return text;
}

const std::string small_case = R"(analysis = "plane-strain"
[workpiece]
material = "s"
mesh = { box = [[0, 0], [5, 7.5]], cells = [2, 3] }
[material.s]
elastic = { young = "210 GPa", poisson = 0.3 }
flow = { law = "voce", yield = 1, saturation = 2, rate = 3 }
[[support]]
where = "x = 0"
move = { y = [[0, 0], [1, -0.5]] }
[[tool]]
name = "p"
surface = { circle = { centre = [8, 0], radius = 2 } }
friction = { law = "coulomb", mu = 0.1 }
[time]
end = 3
)";

TEST(Guards, survive_a_hundred_thousand_mutations) {
  std::mt19937 random(20240229);
  for (int i = 0; i < 100000; ++i) {
    const std::string text = mutated(i % 10 == 0 ? space_case : small_case, random);
    ASSERT_TRUE(survives(text)) << text;
  }
}

} // namespace
} // namespace billet::io::guards_test
