#include "mechanics/materials/flow_table.h"
#include "tests/support/flow_law_checks.h"

namespace billet::mechanics::flow_table_test {
namespace {

const FlowTable table{{{0.0, 300.0}, {0.1, 400.0}, {0.5, 480.0}, {1.0, 430.0}}};

TEST(FlowTable, is_linear_between_its_points) {
  support::check_slope(table, {0.04, 0.3, 0.75, 2.0});
  EXPECT_DOUBLE_EQ(table.flow_stress(0.05).stress, 350.0);
  EXPECT_DOUBLE_EQ(table.flow_stress(0.05).slope, 1000.0);
  EXPECT_DOUBLE_EQ(table.flow_stress(0.75).stress, 455.0);
  EXPECT_DOUBLE_EQ(table.flow_stress(0.75).slope, -100.0);
}

TEST(FlowTable, takes_its_values_at_its_points_and_the_slope_to_the_right) {
  EXPECT_EQ(table.flow_stress(0.0).stress, 300.0);
  EXPECT_DOUBLE_EQ(table.flow_stress(0.0).slope, 1000.0);
  EXPECT_EQ(table.flow_stress(0.1).stress, 400.0);
  EXPECT_DOUBLE_EQ(table.flow_stress(0.1).slope, 200.0);
}

TEST(FlowTable, keeps_its_last_value) {
  for (const double strain : {1.0, 1.0000001, 50.0}) {
    EXPECT_EQ(table.flow_stress(strain).stress, 430.0);
    EXPECT_EQ(table.flow_stress(strain).slope, 0.0);
  }
}

TEST(FlowTable, with_one_point_is_perfect) {
  const FlowTable flat{{{0.0, 250.0}}};
  for (const double strain : {0.0, 0.3, 9.0}) {
    EXPECT_EQ(flat.flow_stress(strain).stress, 250.0);
    EXPECT_EQ(flat.flow_stress(strain).slope, 0.0);
  }
}

} // namespace
} // namespace billet::mechanics::flow_table_test
