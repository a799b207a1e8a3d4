#include "io/case/suggestion.h"

#include <gtest/gtest.h>

namespace billet::io::suggestion_test {
namespace {

TEST(Suggestion, counts_the_edits_between_two_words) {
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("punch", "punch"), 0);
  EXPECT_EQ(edit_distance("pucnh", "punch"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(Suggestion, names_the_nearest_word) {
  EXPECT_EQ(suggestion("yuong", {"poisson", "young"}), "did you mean 'young'?");
  EXPECT_EQ(suggestion("QUAD8", {"quad4", "quad8"}), "did you mean 'quad8'?");
  EXPECT_EQ(suggestion("penalty_tangential", {"penalty", "penalty_tangent"}),
            "did you mean 'penalty_tangent'?");
}

TEST(Suggestion, lists_the_words_when_none_is_near) {
  EXPECT_EQ(suggestion("zzz", {"young", "poisson"}), "known are young, poisson");
  EXPECT_EQ(suggestion("zzz", {}), "");
  EXPECT_EQ(suggestion(std::string(100000, 'a'), {"young"}), "known are young");
}

} // namespace
} // namespace billet::io::suggestion_test
