#include "geometry/base/error.h"
#include "io/results/pvd.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

namespace billet::io::pvd_test {
namespace {

using test::TemporaryFolder;

TEST(Pvd, lists_each_file_with_its_time_and_the_number_of_its_part) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "case.pvd";
  write_pvd(path, {{0.0, "workpiece", "frames/w_0.vtu"},
                   {0.0, "punch", "frames/p_0.vtp"},
                   {0.125, "workpiece", "frames/w_1.vtu"}});
  const std::string text = test::content_of(path);
  EXPECT_NE(text.find("<VTKFile type=\"Collection\""), std::string::npos);
  EXPECT_NE(text.find("timestep=\"0.125\" group=\"\" part=\"0\" name=\"workpiece\" "
                      "file=\"frames/w_1.vtu\""),
            std::string::npos);
  EXPECT_NE(text.find("part=\"1\" name=\"punch\""), std::string::npos);
}

TEST(Pvd, reading_gives_back_what_was_written_whatever_the_names) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "case.pvd";
  const std::vector<PvdEntry> entries{{1.0 / 3.0, "a & \"b\" <c>", "frames/it's.vtu"},
                                      {1e-300, "&amp;", "x.vtu"}};
  write_pvd(path, entries);
  const std::vector<PvdEntry> back = read_pvd(path);
  ASSERT_EQ(back.size(), entries.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].time, entries[i].time);
    EXPECT_EQ(back[i].part, entries[i].part);
    EXPECT_EQ(back[i].file, entries[i].file);
  }
}

TEST(Pvd, an_empty_list_is_a_valid_one) {
  const TemporaryFolder folder;
  write_pvd(folder.path() / "case.pvd", {});
  EXPECT_TRUE(read_pvd(folder.path() / "case.pvd").empty());
}

TEST(Pvd, a_list_that_is_absent_or_damaged_is_an_error) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)read_pvd(folder.path() / "absent.pvd"), Error);
  EXPECT_THROW((void)read_pvd(folder.file("a.pvd", "<DataSet timestep=\"x\" file=\"a.vtu\"/>")),
               Error);
  EXPECT_THROW((void)read_pvd(folder.file("b.pvd", "<DataSet timestep=\"1\"/>")), Error);
}

} // namespace
} // namespace billet::io::pvd_test
