// Every input in corpus/ once: the seeds of the fuzzers and what has made a reader fail before.

#include "tests/fuzz/targets.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace billet::fuzz::corpus_test {
namespace {

class FuzzCorpus : public testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, EndsInAResultOrAnError) {
  const std::filesystem::path folder =
      std::filesystem::path(BILLET_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().corpus;
  int n = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    EXPECT_NO_THROW(GetParam().read(test::content_of(entry.path())));
    ++n;
  }
  EXPECT_GT(n, 0);
}

std::string name_of(const testing::TestParamInfo<Target>& target) {
  return std::string(target.param.name);
}

INSTANTIATE_TEST_SUITE_P(all,
                         FuzzCorpus,
                         testing::ValuesIn(targets().begin(), targets().end()),
                         name_of);

} // namespace
} // namespace billet::fuzz::corpus_test
