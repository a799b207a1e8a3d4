// Input files that include others: where the lines go, what is refused, which line is named.

#include "geometry/base/error.h"
#include "io/mesh/included_lines.h"
#include "io/mesh/read_mesh.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace billet::io::included_lines_test {
namespace {

namespace fs = std::filesystem;
using mechanics::Index;
using test::TemporaryFolder;

constexpr const char* nodes = "*NODE, NSET=all\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n";
constexpr const char* element = "*ELEMENT, TYPE=CPE4, ELSET=body\n1, 1,2,3,4\n";

class IncludedLines : public testing::Test {
protected:
  [[nodiscard]] MeshFile read(const std::string& deck, const IncludeBounds& bounds = {}) const {
    return read_mesh(folder_.file("deck.inp", deck), 1.0, bounds);
  }
  [[nodiscard]] std::string complaint(const std::string& deck,
                                      const IncludeBounds& bounds = {}) const {
    try {
      (void)read(deck, bounds);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::geometry);
      return error.what();
    }
    return "";
  }
  void expect_complaint(const std::string& deck, const std::string& wanted) const {
    const std::string text = complaint(deck);
    EXPECT_NE(text.find(wanted), std::string::npos) << text;
  }

  void file(const std::string& name, std::string_view text) const {
    static_cast<void>(folder_.file(name, text));
  }
  TemporaryFolder folder_;
};

TEST_F(IncludedLines, stand_in_the_place_of_the_keyword) {
  file("all.msh", std::string(nodes) + element);
  file("top.nam", "** written by cgx\n*NSET,NSET=top\n3,\n4,\n");
  const MeshFile file = read("*include, input=all.msh\n*INCLUDE,\nINPUT=top.nam\n*STEP\n");
  EXPECT_EQ(file.mesh.n_elements(), 1);
  EXPECT_EQ(file.mesh.node_sets.at("top"), (std::vector<Index>{2, 3}));
}

TEST_F(IncludedLines, may_be_the_data_of_a_keyword) {
  file("points.txt", "1,0,0\n2,1,0\n3,1,1");
  file("cells.txt", "1, 1,2\n");
  const MeshFile file = read("*NODE, NSET=all\n* Include , Input = points.txt\n4,0,1\n"
                             "*ELEMENT, TYPE=CPE4, INPUT=cells.txt\n3,4\n");
  EXPECT_EQ(file.mesh.n_elements(), 1);
  EXPECT_EQ(file.mesh.node_sets.at("all").size(), 4U);
}

TEST_F(IncludedLines, names_may_have_quotes_blanks_commas_and_backslashes) {
  fs::create_directories(folder_.path() / "a part, meshed");
  file("a part, meshed/all nodes.msh", nodes);
  file("a part, meshed/all.msh", element);
  const MeshFile file = read("*INCLUDE, INPUT=\"a part, meshed/all nodes.msh\"\r\n"
                             "*INCLUDE, INPUT=\"a part, meshed\\all.msh\"\r\n");
  EXPECT_EQ(file.mesh.n_elements(), 1);
}

TEST_F(IncludedLines, a_byte_order_mark_is_passed_over) {
  file("all.msh", std::string("\xEF\xBB\xBF") + nodes + element);
  EXPECT_EQ(read("\xEF\xBB\xBF*INCLUDE, INPUT=all.msh\n").mesh.n_elements(), 1);
}

TEST_F(IncludedLines, relative_names_count_from_the_first_file) {
  fs::create_directories(folder_.path() / "mesh");
  file("mesh/part.inc", "*INCLUDE, INPUT=mesh/nodes.inc\n");
  file("mesh/nodes.inc", nodes);
  EXPECT_EQ(read(std::string("*INCLUDE, INPUT=mesh/part.inc\n") + element).mesh.n_elements(), 1);
}

TEST_F(IncludedLines, failures_name_the_included_file_and_its_line) {
  file("all.msh", std::string(nodes) + "5,one,0\n");
  expect_complaint("*HEADING\n*INCLUDE,INPUT=all.msh\n", "all.msh:6: \"one\" is not a finite");
  file("all.msh", std::string(nodes) + "*ELEMENT,TYPE=CPE4\n1, 1,2,3\n");
  expect_complaint("*INCLUDE,INPUT=all.msh\n*STEP\n", "all.msh:7: element 1 of type CPE4 has only");
  file("top.nam", "*NSET,NSET=top\n9\n");
  expect_complaint(std::string(nodes) + element + "*INCLUDE,INPUT=top.nam\n",
                   "top.nam:2: the set top has node 9");
  file("ties.inc", "*EQUATION\n2\n1,1,1.,2,1,-1.\n*EQUATION\n2\n1,2,1.,2,2,-1.\n");
  const MeshFile file = read(std::string(nodes) + element + "*INCLUDE,INPUT=ties.inc\n");
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("ties.inc:1: *EQUATION is passed over"), std::string::npos);
}

TEST_F(IncludedLines, files_that_are_not_there_are_named_where_they_are_included) {
  expect_complaint("*HEADING\n*INCLUDE, INPUT=All.msh\n",
                   "deck.inp:2: \"All.msh\" is to be included, but there is no such file");
  fs::create_directories(folder_.path() / "sub");
  expect_complaint("*INCLUDE, INPUT=sub\n", "folder or device");
}

TEST_F(IncludedLines, no_file_includes_itself) {
  expect_complaint("*INCLUDE, INPUT=./deck.inp\n", "deck.inp:1: \"./deck.inp\" includes itself");
  file("a.inc", "*INCLUDE, INPUT=b.inc\n");
  file("b.inc", "** round and round\n*INCLUDE, INPUT=a.inc\n");
  expect_complaint("*INCLUDE, INPUT=a.inc\n", "b.inc:2: \"a.inc\" includes itself");
}

TEST_F(IncludedLines, depth_number_and_size_are_bounded) {
  for (int i = 0; i < 30; ++i)
    file(fmt::format("{}.inc", i).c_str(), fmt::format("*INCLUDE, INPUT={}.inc\n", i + 1));
  expect_complaint("*INCLUDE, INPUT=0.inc\n", "15.inc:1: files include each other more than 16");
  file("empty.inc", "**\n");
  std::string many;
  for (int i = 0; i < 1001; ++i)
    many += "*INCLUDE, INPUT=empty.inc\n";
  expect_complaint(many, "deck.inp:1001: more than 1000 files");
  fs::resize_file(folder_.file("huge.inc", ""), 3'000'000'000); // takes no room on disk
  expect_complaint("*INCLUDE, INPUT=huge.inc\n", "more than 2e+09 bytes");
}

TEST_F(IncludedLines, come_from_allowed_folders_only) {
  const TemporaryFolder elsewhere;
  const fs::path far = elsewhere.file("all.msh", std::string(nodes) + element);
  const std::string deck = "*INCLUDE, INPUT=" + far.string() + "\n";
  expect_complaint(deck, "outside the folder of this file");
  expect_complaint("*INCLUDE, INPUT=../deck.inp\n", "outside the folder of this file");
  fs::create_symlink(far, folder_.path() / "link.msh");
  expect_complaint("*INCLUDE, INPUT=link.msh\n", "outside the folder of this file");
  EXPECT_EQ(read(deck, {elsewhere.path()}).mesh.n_elements(), 1);
  EXPECT_EQ(read(deck, {{}, true}).mesh.n_elements(), 1);
}

} // namespace
} // namespace billet::io::included_lines_test
