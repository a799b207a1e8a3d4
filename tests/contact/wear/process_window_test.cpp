#include "contact/wear/process_window.h"

#include <gtest/gtest.h>

namespace billet::contact::process_window_test {
namespace {

/// Two contact points over two integration points of the bulk.
struct Bench {
  std::vector<std::size_t> point{0, 1};
  std::vector<double> strain{0.1, 0.3};
  std::vector<double> rate{1.0, 3.0};

  [[nodiscard]] BulkFields bulk_fields() const { return {point, strain, rate}; }
};

ClosedPoint closed_point(std::size_t point, double pressure_old, double pressure, double area) {
  ClosedPoint at;
  at.point = point;
  at.pressure_old = pressure_old;
  at.pressure = pressure;
  at.slip = 0.2;
  at.sliding = 1.0 + static_cast<double>(point);
  at.area = area;
  return at;
}

TEST(ProcessWindow, weighs_with_area_and_time) {
  const Bench bench;
  ProcessWindow window(1);
  const std::vector<std::vector<ClosedPoint>> both{
      {closed_point(0, 0.0, 100.0, 1.0), closed_point(1, 200.0, 400.0, 3.0)}};
  const std::vector<std::vector<ClosedPoint>> one{{closed_point(1, 400.0, 600.0, 3.0)}};
  window.add(both, bench.bulk_fields(), 0.5);
  window.add(one, bench.bulk_fields(), 2.0);
  const Window found = window.tool(0);
  EXPECT_DOUBLE_EQ(found.contact_time, 2.5);
  EXPECT_DOUBLE_EQ(found.mean_area, (4.0 * 0.5 + 3.0 * 2.0) / 2.5);
  const WindowRange& pressure = found[WindowQuantity::pressure];
  EXPECT_DOUBLE_EQ(pressure.mean, (50.0 * 0.5 + 900.0 * 0.5 + 1500.0 * 2.0) / 8.0);
  EXPECT_EQ(pressure.lowest, 100.0);
  EXPECT_EQ(pressure.highest, 600.0);
  EXPECT_DOUBLE_EQ(pressure.last_mean, 500.0);
  const WindowRange& speed = found[WindowQuantity::speed];
  EXPECT_DOUBLE_EQ(speed.mean, (4.0 * 0.2 + 3.0 * 0.2) / 8.0);
  EXPECT_DOUBLE_EQ(speed.lowest, 0.1);
  EXPECT_DOUBLE_EQ(speed.highest, 0.4);
  EXPECT_DOUBLE_EQ(found[WindowQuantity::strain].mean, (0.1 * 0.5 + 0.3 * 7.5) / 8.0);
  EXPECT_DOUBLE_EQ(found[WindowQuantity::strain_rate].mean, (1.0 * 0.5 + 3.0 * 7.5) / 8.0);
  EXPECT_DOUBLE_EQ(found[WindowQuantity::sliding].highest, 2.0);
}

TEST(ProcessWindow, keeps_tools_apart_and_sums_them_up) {
  const Bench bench;
  ProcessWindow window(3);
  std::vector<std::vector<ClosedPoint>> closed(3);
  closed[0] = {closed_point(0, 100.0, 100.0, 1.0)};
  closed[1] = {closed_point(1, 300.0, 300.0, 1.0)};
  window.add(closed, bench.bulk_fields(), 1.0);
  closed[0].clear();
  window.add(closed, bench.bulk_fields(), 1.0);
  EXPECT_EQ(window.tool(0)[WindowQuantity::pressure].mean, 100.0);
  EXPECT_EQ(window.tool(0).contact_time, 1.0);
  EXPECT_EQ(window.tool(1)[WindowQuantity::pressure].mean, 300.0);
  EXPECT_EQ(window.tool(1).contact_time, 2.0);
  EXPECT_EQ(window.tool(2).contact_time, 0.0) << "never touched";
  EXPECT_DOUBLE_EQ(window.total()[WindowQuantity::pressure].mean, 700.0 / 3.0);
  EXPECT_EQ(window.total().contact_time, 2.0);
}

TEST(ProcessWindow, takes_the_speed_while_a_point_touches) {
  // (C.42): a fifth of the increment, and none predicted.
  const Bench bench;
  ProcessWindow window(1);
  ClosedPoint landed = closed_point(0, 0.0, 100.0, 1.0), surprised = closed_point(1, 0.0, 1.0, 1.0);
  landed.touching = 0.2;
  surprised.touching = 0.0;
  surprised.slip = 0.0;
  const std::vector<std::vector<ClosedPoint>> closed{{landed, surprised}};
  window.add(closed, bench.bulk_fields(), 0.5);
  const Window found = window.tool(0);
  const WindowRange& speed = found[WindowQuantity::speed];
  EXPECT_DOUBLE_EQ(speed.highest, 0.2 / (0.2 * 0.5));
  EXPECT_EQ(speed.lowest, 0.0);
  EXPECT_DOUBLE_EQ(speed.mean, 0.5 * 0.2 / 0.5) << "over the increment, as the pressure";
}

} // namespace
} // namespace billet::contact::process_window_test
