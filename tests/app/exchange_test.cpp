// What the program gives to other programs and takes from them: schema, differences, completion,
// the manual, codes, decks.

#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

namespace billet::test::exchange_test {

namespace {

namespace fs = std::filesystem;

class Exchange : public testing::Test {
protected:
  Exchange() { write_text(folder_.path() / "tiny.toml", upsetting); }
  [[nodiscard]] Outcome run(std::vector<std::string> words) const {
    return billet(std::move(words), folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(Exchange, schema_goes_to_standard_output_or_to_a_file) {
  const Outcome printed = run({"schema"});
  EXPECT_EQ(printed.status, 0) << printed.err;
  EXPECT_TRUE(printed.prints("json-schema.org/draft/2020-12"));
  EXPECT_EQ(run({"schema", "case", "-o", "case.json"}).status, 0);
  EXPECT_EQ(whole_file(folder_.path() / "case.json"), printed.out);
  EXPECT_TRUE(run({"schema", "study"}).prints("\"vary\""));
  EXPECT_TRUE(run({"schema", "chart"}).prints("\"uncertain\""));
  EXPECT_TRUE(run({"schema", "sudy"}).says("did you mean 'study'?"));
  EXPECT_EQ(run({"schema", "case", "study"}).status, 2);
}

TEST_F(Exchange, results_are_the_same_as_themselves_and_differ_from_others) {
  ASSERT_EQ(run({"run", "tiny.toml", "-o", "a", "--quiet"}).status, 0);
  ASSERT_EQ(run({"run", "tiny.toml", "-o", "b", "--quiet", "--set",
                 "material.steel.elastic.young=150000"})
                .status,
            0);
  const Outcome same = run({"diff", "a", "a"});
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_TRUE(same.prints("0 of "));
  const Outcome other = run({"diff", "a", "b"});
  EXPECT_EQ(other.status, 1);
  EXPECT_TRUE(other.prints("history plastic_work")) << other.out;
  EXPECT_TRUE(other.prints("field plastic_strain")) << other.out;
  EXPECT_EQ(run({"diff", "a", "b", "--atol", "1e30"}).status, 0);
}

TEST_F(Exchange, case_files_differ_by_keys_with_their_defaults) {
  write_text(folder_.path() / "same.toml", upsetting + "\n[contact]\npenalty = 100\n");
  write_text(folder_.path() / "other.toml", upsetting + "\n[contact]\npenalty = 200\n");
  EXPECT_EQ(run({"diff", "tiny.toml", "same.toml"}).status, 0);
  const Outcome other = run({"diff", "tiny.toml", "other.toml"});
  EXPECT_EQ(other.status, 1);
  EXPECT_TRUE(other.prints("contact.penalty")) << other.out;
  EXPECT_TRUE(other.prints("1 of ")) << other.out;
}

TEST_F(Exchange, trouble_of_a_comparison_has_a_status_of_its_own) {
  fs::create_directory(folder_.path() / "empty");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"diff", "empty", "empty"},
                                                {"diff", "tiny.toml", "none.toml"},
                                                {"diff", "tiny.toml", "empty"},
                                                {"diff", "tiny.toml"},
                                                {"diff", "tiny.toml", "tiny.toml", "--rtol", "-1"}})
    EXPECT_EQ(run(words).status, 2) << words[1];
}

TEST_F(Exchange, every_shell_gets_all_commands_and_options) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Outcome script = run({"completion", shell});
    EXPECT_EQ(script.status, 0);
    for (const char* word :
         {"run", "check", "import", "explain", "resume", "allow-outside", "rtol"})
      EXPECT_TRUE(script.prints(word)) << shell << ' ' << word;
  }
  EXPECT_EQ(run({"completion"}).status, 2);
  EXPECT_TRUE(run({"completion", "zhs"}).says("did you mean 'zsh'?"));
}

/// What bash offers for a line, the last word of which is being typed.
std::string offered(const std::string& words, const fs::path& folder) {
  write_text(folder / "ask", "source <(\"$1\" completion bash)\ncd \"$2\"\nshift 2\n"
                             "COMP_WORDS=(\"$@\") COMP_CWORD=$(($# - 1))\n"
                             "_billet\nprintf '%s ' \"${COMPREPLY[@]}\" >offers\n");
  const std::string command = "bash '" + (folder / "ask").string() + "' '" BILLET_PROGRAM "' '" +
                              folder.string() + "' billet " + words;
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return whole_file(folder / "offers");
}

TEST_F(Exchange, bash_offers_commands_options_cases_and_folders) {
  fs::create_directory(folder_.path() / "results");
  write_text(folder_.path() / "notes.txt", "");
  EXPECT_EQ(offered("ru", folder_.path()), "run ");
  EXPECT_EQ(offered("run --re", folder_.path()), "--resume ");
  EXPECT_EQ(offered("run t", folder_.path()), "tiny.toml ");
  EXPECT_EQ(offered("run n", folder_.path()), " "); // notes.txt is no case
  EXPECT_EQ(offered("run tiny.toml -o r", folder_.path()), "results ");
  EXPECT_EQ(offered("explain tool-m", folder_.path()), "tool-misses ");
  EXPECT_EQ(offered("completion f", folder_.path()), "fish ");
}

TEST_F(Exchange, the_manual_has_every_command_and_exit_status) {
  const Outcome page = run({"manual"});
  EXPECT_EQ(page.status, 0);
  for (const char* piece : {".TH BILLET 1", ".SS billet run", "\\fB\\-\\-set\\fR",
                            ".SH EXIT STATUS", "\\fB129/130/143\\fR"})
    EXPECT_TRUE(page.prints(piece)) << piece;
}

// --- codes --------------------------------------------------------------------------------------

std::set<std::string> found_in(const fs::path& file, const std::vector<std::regex>& patterns) {
  std::set<std::string> codes;
  const std::string text = whole_file(file);
  for (const std::regex& pattern : patterns)
    for (auto at = std::sregex_iterator(text.begin(), text.end(), pattern);
         at != std::sregex_iterator(); ++at)
      codes.insert((*at)[1]);
  return codes;
}

/// Codes that the sources give: of warnings, causes, slips, failed checks, ends and advice.
std::set<std::string> used_codes() {
  const std::string code = "([a-z]+(?:-[a-z0-9]+)*)";
  const std::vector<std::regex> everywhere{std::regex("\"warning: \\[" + code + "\\]"),
                                           std::regex("add_slip\\(\\s*slips,\\s*\"" + code + "\""),
                                           std::regex("FailedCheck\\{\\s*\"" + code + "\""),
                                           std::regex("return ended\\(\\s*\"" + code + "\"")};
  const std::vector<std::regex> of_causes{std::regex("\"\\[" + code + "\\] ")};
  const std::vector<std::regex> of_advice{std::regex("return \"" + code + "\"")};
  std::set<std::string> codes;
  for (const char* part : {"app", "io", "process", "study"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(BILLET_SOURCE_DIR) / part)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".cpp" && file.extension() != ".h")
        continue;
      codes.merge(found_in(file, everywhere));
      if (file.filename() == "advice.cpp")
        codes.merge(found_in(file, of_causes));
      if (file.filename() == "scene_advice.cpp")
        codes.merge(found_in(file, of_advice));
    }
  const std::vector<std::regex> of_errors{std::regex("string_view \\w+ = \"" + code + "\"")};
  codes.merge(found_in(fs::path(BILLET_SOURCE_DIR) / "geometry/base/error.h", of_errors));
  return codes;
}

/// Codes that `billet explain` lists, but for exit statuses.
std::set<std::string> explained_codes(const std::string& list) {
  std::set<std::string> codes;
  const std::regex line("(?:^|\n)  ([a-z]+(?:-[a-z0-9]+)*) ");
  for (auto at = std::sregex_iterator(list.begin(), list.end(), line); at != std::sregex_iterator();
       ++at)
    if (!(*at)[1].str().starts_with("exit-"))
      codes.insert((*at)[1]);
  return codes;
}

TEST_F(Exchange, every_code_is_explained_and_every_explanation_is_of_a_code) {
  const std::set<std::string> used = used_codes();
  EXPECT_GT(used.size(), 70U);
  EXPECT_EQ(used, explained_codes(run({"explain"}).out));
}

TEST_F(Exchange, every_warning_has_a_code) {
  const std::regex bare("\"warning: [^\\[\"]");
  for (const char* part : {"app", "io", "process", "study", "contact", "mechanics", "geometry"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(BILLET_SOURCE_DIR) / part))
      if (entry.path().extension() == ".cpp") {
        const std::string text = whole_file(entry.path());
        EXPECT_FALSE(std::regex_search(text, bare)) << entry.path();
      }
}

TEST_F(Exchange, every_error_ends_with_a_code_that_is_explained) {
  const auto file = [&](const char* name, const char* text) {
    write_text(folder_.path() / name, text);
    return std::string(name);
  };
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> commands{
      {{"check", file("broken.toml", "title = [")}, {"toml-syntax"}},
      {{"check", file("wrong.toml", "analysis = \"plane\"\nwrokpiece = {}\n")},
       {"value-refused", "key-unknown", "key-missing"}},
      {{"run", "none.toml"}, {"file"}},
      {{"info", file("cut.msh", "$MeshFormat\n")}, {"mesh-file"}},
      {{"info", file("cut.stl", "solid x\nfacet")}, {"surface-file"}},
      {{"info", "none.stl"}, {"file"}},
      {{"run", "--no-such-option"}, {"usage"}},
  };
  for (const auto& [words, codes] : commands) {
    std::istringstream lines(run(words).err);
    std::set<std::string> found;
    for (std::string line; std::getline(lines, line);) {
      std::smatch code;
      EXPECT_TRUE(std::regex_match(line, code, std::regex("[^\\[]* \\[([a-z-]+)\\]"))) << line;
      found.insert(code[1]);
    }
    EXPECT_EQ(found, std::set<std::string>(codes.begin(), codes.end())) << words.back();
    for (const std::string& code : codes)
      EXPECT_EQ(run({"explain", code}).status, 0) << code;
  }
}

TEST_F(Exchange, every_code_stands_on_the_page_of_messages) {
  const std::string page = whole_file(fs::path(BILLET_SOURCE_DIR) / "docs/guide/messages.md");
  for (const std::string& code : explained_codes(run({"explain"}).out))
    EXPECT_NE(page.find("`" + code + "`"), std::string::npos) << code;
}

TEST_F(Exchange, explains_a_code_as_it_is_copied_from_a_message) {
  for (const char* word : {"tool-misses", "[tool-misses]", "5", "exit-5", "exit status 5"}) {
    const Outcome outcome = run({"explain", word});
    EXPECT_EQ(outcome.status, 0) << word << outcome.err;
  }
  EXPECT_TRUE(run({"explain", "energy-balance"}).prints("failed check"));
  EXPECT_TRUE(run({"explain", "143"}).prints("SIGTERM"));
  const Outcome wrong = run({"explain", "tool-mises"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(wrong.says("did you mean 'tool-misses'?")) << wrong.err;
}

TEST_F(Exchange, every_status_of_the_help_is_explained) {
  for (const char* status :
       {"0", "1", "2", "3", "4", "5", "6", "7", "8", "70", "129", "130", "143"})
    EXPECT_EQ(run({"explain", status}).status, 0) << status;
}

TEST_F(Exchange, a_deck_becomes_a_case_that_runs) {
  write_text(folder_.path() / "disk.inp", R"(*NODE
1, 0., 0.
2, 2.5, 0.
3, 5., 0.
4, 0., 2.5
5, 2.5, 2.5
6, 5., 2.5
7, 0., 5.
8, 2.5, 5.
9, 5., 5.
99, 0., 6.
*ELEMENT, TYPE=CAX4, ELSET=PART
1, 1, 2, 5, 4
2, 2, 3, 6, 5
3, 4, 5, 8, 7
4, 5, 6, 9, 8
*SURFACE, NAME=TOP
3, S3
4, S3
*SURFACE, TYPE=SEGMENTS, NAME=DIE
START, 10., 5.
LINE, -1., 5.
*RIGID BODY, ANALYTICAL SURFACE=DIE, REF NODE=99
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*PLASTIC
300., 0.
500., 0.5
*SOLID SECTION, ELSET=PART, MATERIAL=STEEL
*SURFACE INTERACTION, NAME=DRY
*FRICTION
0.1,
*CONTACT PAIR, INTERACTION=DRY
TOP, DIE
*NSET, NSET=AXIS
1, 4, 7
*NSET, NSET=FOOT
1, 2, 3
*EXPANSION
1e-5
*STEP, NLGEOM
*STATIC
0.1, 1.
*BOUNDARY
AXIS, 1
FOOT, 2
99, 2, 2, -1.
99, 1
*END STEP
)");
  const Outcome made = run({"import", "disk.inp"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_TRUE(made.prints("disk.inp:40: *EXPANSION: not understood")) << made.out;
  EXPECT_TRUE(made.prints("mm-t-s-N (--units changes that)"));
  const Outcome result = run({"run", "disk/case.toml", "-o", "out", "--quiet"});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
  EXPECT_EQ(run({"import", "disk.inp"}).status, 2); // it does not write over a case
  EXPECT_EQ(run({"import", "disk.inp", "-o", "again", "--units", "inch"}).status, 2);
}

} // namespace

} // namespace billet::test::exchange_test
