// A broken input, what the program must say of it, and the check of both `check` and `run`.

#pragma once

#include "tests/support/case_texts.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <string>
#include <utility>
#include <vector>

namespace billet::test {

struct Broken {
  std::string name;              ///< of the test
  std::string text;              ///< of case.toml
  int status;                    ///< of the program
  std::vector<std::string> says; ///< pieces of the message
  std::vector<std::string> at;   ///< text of case.toml whose lines the message names
  std::vector<std::pair<std::string, std::string>> files = {}; ///< in the folder of the case
};

inline void expect_refused(const Broken& broken, const Outcome& outcome) {
  EXPECT_FALSE(outcome.crashed) << outcome.err;
  EXPECT_EQ(outcome.status, broken.status) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("billet: ")) << outcome.err;
  EXPECT_FALSE(outcome.says("internal error")) << outcome.err;
  for (const std::string& piece : broken.says)
    EXPECT_TRUE(outcome.says(piece)) << "'" << piece << "' is not in: " << outcome.err;
  for (const std::string& piece : broken.at) {
    const std::string place = "case.toml:" + std::to_string(line_of(broken.text, piece)) + ":";
    EXPECT_TRUE(outcome.says(place)) << "'" << place << "' is not in: " << outcome.err;
  }
}

/// Neither `check` nor `run` takes it, they agree, and no results are left behind.
inline void expect_refused(const Broken& broken) {
  const TemporaryFolder folder;
  write_text(folder.path() / "case.toml", broken.text);
  for (const auto& [name, content] : broken.files)
    write_text(folder.path() / name, content);
  const Outcome check = billet({"check", "case.toml"}, folder.path());
  expect_refused(broken, check);
  const Outcome run = billet({"run", "case.toml", "--quiet", "-o", "out"}, folder.path());
  expect_refused(broken, run);
  EXPECT_EQ(check.err, run.err);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

inline std::string name_of(const testing::TestParamInfo<Broken>& info) { return info.param.name; }

inline std::ostream& operator<<(std::ostream& stream, const Broken& broken) {
  return stream << broken.name;
}

} // namespace billet::test
