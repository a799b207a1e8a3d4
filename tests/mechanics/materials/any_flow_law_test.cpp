#include "mechanics/materials/any_flow_law.h"
#include "tests/support/sample_materials.h"

#include <gtest/gtest.h>

#include <set>

namespace billet::mechanics::any_flow_law_test {
namespace {

TEST(AnyFlowLaw, lists_every_law_once_under_its_own_name) {
  std::set<std::string> names;
  for (const auto& [name, material] : support::every_material())
    names.insert(name);
  EXPECT_EQ(names.size(), std::variant_size_v<AnyFlowLaw>)
      << "a law without a sample in tests/support, or two laws of one name";
}

} // namespace
} // namespace billet::mechanics::any_flow_law_test
