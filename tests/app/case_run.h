// A fixture for tests that run one case file with the program and look at its results.

#pragma once

#include "tests/app/tables.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace billet::test {

class CaseRun : public testing::Test {
protected:
  /// Runs a case on one thread, its results in `out`.
  Outcome run(const std::string& text) const {
    write_text(folder_.path() / "case.toml", text);
    return billet({"run", "case.toml", "--quiet", "-o", "out", "--threads", "1"}, folder_.path());
  }
  [[nodiscard]] ResultTable history() const {
    return read_table(folder_.path() / "out" / "history.csv");
  }
  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(whole_file(folder_.path() / "out" / "summary.json"));
  }

  TemporaryFolder folder_;
};

} // namespace billet::test
