// Which program users started, of one that a package has twice.

#include "app/processor.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace billet::test::processor_test {

namespace {

class StartedProgram : public testing::Test {
protected:
  [[nodiscard]] std::filesystem::path at(const char* file) const { return folder_.path() / file; }
  void make(const char* file) const {
    std::filesystem::create_directories(at(file).parent_path());
    write_text(at(file), "");
  }
  TemporaryFolder folder_;
};

TEST_F(StartedProgram, is_that_of_bin_for_the_faster_one) {
  make("bin/billet");
  make("lib/billet/x86-64-v3/billet");
  EXPECT_EQ(app::started_program(at("lib/billet/x86-64-v3/billet")), at("bin/billet"));
}

TEST_F(StartedProgram, is_itself_where_there_is_none_in_bin) {
  make("lib/billet/x86-64-v3/billet");
  EXPECT_EQ(app::started_program(at("lib/billet/x86-64-v3/billet")),
            at("lib/billet/x86-64-v3/billet"));
}

TEST_F(StartedProgram, is_itself_elsewhere) {
  make("bin/billet");
  make("lib/other/x86-64-v3/billet");
  EXPECT_EQ(app::started_program(at("bin/billet")), at("bin/billet"));
  EXPECT_EQ(app::started_program(at("lib/other/x86-64-v3/billet")),
            at("lib/other/x86-64-v3/billet"));
}

} // namespace

} // namespace billet::test::processor_test
