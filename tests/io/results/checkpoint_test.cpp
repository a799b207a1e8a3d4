#include "geometry/base/error.h"
#include "io/results/checkpoint.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace billet::io::checkpoint_test {
namespace {

namespace fs = std::filesystem;

Checkpoint sample(int increment, double time) {
  return {.version = "1.2.3",
          .title = "Sample",
          .reason = "in the midst of the run",
          .written = "2026-01-01 00:00:00",
          .time = time,
          .increment = increment,
          .stage = 1,
          .n_unknowns = 12,
          .scene = "0123abcd",
          .content = "title = \"Sample\"\n",
          .run = std::string("bytes\0of a run", 14),
          .results = "bytes of its results"};
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Checkpoints : public testing::Test {
protected:
  void put(const fs::path& file, const std::string& bytes) const {
    std::ofstream(file, std::ios::binary) << bytes;
  }
  [[nodiscard]] std::string complaint(const fs::path& file) const {
    try {
      (void)read_checkpoint(file);
    } catch (const Error& error) {
      EXPECT_EQ(error.fault(), Fault::input_output);
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

TEST_F(Checkpoints, AreReadAsTheyWereWritten) {
  write_checkpoint(folder_.path(), sample(7, 0.5));
  const Checkpoint read = read_checkpoint(folder_.path() / "checkpoints" / "00000007.checkpoint");
  EXPECT_EQ(read.version, "1.2.3");
  EXPECT_EQ(read.time, 0.5);
  EXPECT_EQ(read.increment, 7);
  EXPECT_EQ(read.stage, 1u);
  EXPECT_EQ(read.n_unknowns, 12u);
  EXPECT_EQ(read.scene, "0123abcd");
  EXPECT_EQ(read.content, sample(7, 0.5).content);
  EXPECT_EQ(read.run, sample(7, 0.5).run);
  EXPECT_EQ(read.results, sample(7, 0.5).results);
}

TEST_F(Checkpoints, OfARunAreTheLastTwo) {
  for (const int increment : {9, 10, 11, 100})
    write_checkpoint(folder_.path(), sample(increment, 0.01 * increment));
  const auto files = checkpoints_of(folder_.path());
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].filename(), "00000100.checkpoint");
  EXPECT_EQ(files[1].filename(), "00000011.checkpoint");
  EXPECT_EQ(latest_checkpoint(folder_.path()).checkpoint.increment, 100);
  EXPECT_EQ(latest_checkpoint(folder_.path(), 0.5).checkpoint.increment, 11);
  EXPECT_THROW((void)latest_checkpoint(folder_.path(), 0.05), Error);
  remove_checkpoints_after(folder_.path(), 11);
  EXPECT_EQ(checkpoints_of(folder_.path()).size(), 1u);
}

TEST_F(Checkpoints, TellOfEveryBitThatIsDamaged) {
  write_checkpoint(folder_.path(), sample(7, 0.5));
  const fs::path file = checkpoints_of(folder_.path()).front();
  const std::string sound = bytes_of(file);
  ASSERT_GT(8 * sound.size(), 2000u);
  for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
    std::string damaged = sound;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    put(file, damaged);
    ASSERT_FALSE(complaint(file).empty()) << "bit " << bit;
  }
  for (std::size_t size = 0; size < sound.size(); ++size) {
    put(file, sound.substr(0, size));
    ASSERT_FALSE(complaint(file).empty()) << "cut to " << size;
  }
  put(file, sound + "x");
  EXPECT_NE(complaint(file).find("something follows"), std::string::npos);
}

TEST_F(Checkpoints, GiveWayToTheOneBefore) {
  write_checkpoint(folder_.path(), sample(7, 0.5));
  write_checkpoint(folder_.path(), sample(8, 0.6));
  const fs::path file = checkpoints_of(folder_.path()).front();
  std::string bytes = bytes_of(file);
  bytes.back() = 'x';
  put(file, bytes);
  const FoundCheckpoint found = latest_checkpoint(folder_.path());
  EXPECT_EQ(found.checkpoint.increment, 7);
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_NE(found.notes[0].find("'results' does not agree with its checksum"), std::string::npos);
}

TEST(ChangesOfCase, AreNamedUnlessTheyLieAhead) {
  const std::string before = "title = \"a\"\n[time]\nend = 2.0\n[contact]\npenalty = 100.0\n"
                             "[[stage]]\nname = \"one\"\nend = 1.0\n"
                             "[[stage]]\nname = \"two\"\nend = 2.0\n"
                             "[output]\nevery = 0.1\n[solver]\nthreads = 1\ntolerance = 1e-6\n";
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string text = before;
    text.replace(text.find(old), old.size(), now);
    return text;
  };
  EXPECT_TRUE(changes_of_case(before, before, 0).empty());
  EXPECT_TRUE(changes_of_case(before, with("\"a\"", "\"b\""), 0).empty());
  EXPECT_TRUE(
      changes_of_case(before, with("end = 2.0\n[contact]", "end = 3.0\n[contact]"), 0).empty());
  EXPECT_TRUE(changes_of_case(before, with("every = 0.1", "every = 0.2"), 1).empty());
  EXPECT_TRUE(changes_of_case(before, with("threads = 1", "threads = 4"), 1).empty());
  EXPECT_TRUE(changes_of_case(before, with("\"two\"", "\"three\""), 0).empty());
  EXPECT_TRUE(changes_of_case(before, with("\"one\"\nend = 1.0", "\"one\"\nend = 1.5"), 0).empty());
  const auto stage = changes_of_case(before, with("\"two\"", "\"three\""), 1);
  ASSERT_EQ(stage.size(), 1u);
  EXPECT_EQ(stage[0], "stage[2].name was \"two\", is \"three\"");
  const auto penalty = changes_of_case(before, with("penalty = 100.0", "penalty = 50.0"), 0);
  ASSERT_EQ(penalty.size(), 1u);
  EXPECT_EQ(penalty[0], "contact.penalty was 100, is 50");
  const auto gone = changes_of_case(before, with("tolerance = 1e-6\n", ""), 0);
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_NE(gone[0].find("is absent"), std::string::npos);
}

} // namespace
} // namespace billet::io::checkpoint_test
