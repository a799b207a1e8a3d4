#include "io/case/other_words.h"

#include <gtest/gtest.h>

namespace billet::io::other_words_test {
namespace {

TEST(OtherWords, stand_for_ours_where_these_are_known) {
  const std::vector<std::string> friction{"frictionless", "coulomb", "tresca"};
  EXPECT_EQ(our_word("shear", friction)->word, "tresca");
  EXPECT_EQ(our_word("Constant Shear", friction)->word, "tresca");
  EXPECT_EQ(our_word("COULOMB_TRESCA", friction)->word, "coulomb");
  EXPECT_FALSE(our_word("hollomon", friction).has_value());
  EXPECT_FALSE(our_word("", friction).has_value());
}

TEST(OtherWords, mean_another_thing_in_another_place) {
  EXPECT_EQ(our_word("E", {"young", "poisson"})->word, "young");
  EXPECT_EQ(our_word("E", {"elastic", "flow"})->word, "elastic");
  EXPECT_EQ(our_word("yield", {"elastic", "flow"})->word, "flow");
}

} // namespace
} // namespace billet::io::other_words_test
